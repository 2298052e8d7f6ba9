"""Values under the pointer, the explanation of a pixel, the tables."""
import unittest

from selenium.webdriver.common.keys import Keys

from support import SAME, VALUES, ReportTest


class Pixel(ReportTest):
    def setUp(self):
        super().setUp()
        self.open_scene(VALUES)

    def read(self, x, y):
        self.to_pixel(x, y).perform()
        self.wait(lambda: f"x {x}, y {y}" in self.text(".readout"))
        return self.readout()

    def test_hdr_values(self):
        self.assertEqual([["12.5", "13", "+0.5"], ["0.25", "0.25", "0"], ["0.25", "0.25", "0"]], self.read(3, 2))

    def test_every_bit_of_a_float_is_told(self):
        self.assertEqual(["0.1", "0.10000001", "+7.451e-9"], self.read(5, 4)[1])

    def test_nan_and_infinity(self):
        self.assertEqual(["0.25", "NaN", "NaN"], self.read(7, 6)[2])
        self.assertIn("not finite", self.text(".readout"))
        self.assertEqual(["0.25", "-Inf", "-Inf"], self.read(8, 6)[2])

    def test_the_cause_stands_by_the_pixel(self):
        self.read(20, 10)
        self.assertIn("silhouette", self.text(".readout"))
        self.read(21, 10)
        self.assertIn("within the tolerance", self.text(".readout"))

    def test_corners_are_the_corners(self):
        self.to_pixel(0, 0).perform()
        self.wait(lambda: "x 0, y 0" in self.text(".readout"))
        self.to_pixel(39, 29).perform()
        self.wait(lambda: "x 39, y 29" in self.text(".readout"))

    def test_a_click_explains(self):
        self.to_pixel(3, 2).click().perform()
        self.wait(lambda: "pixel=3%2C2" in self.browser.current_url)
        self.assertEqual("camera ray\n  hit <b>ball</b> at t = 2.5", self.text(".explanation pre"))
        self.assertEqual("plumb explain scenes/values.sdf 3 2", self.text(".explanation code"))

    def test_a_click_without_text_gives_the_command(self):
        self.to_pixel(20, 10).click().perform()
        self.wait(lambda: self.text(".explanation code") == "plumb explain scenes/values.sdf 20 10")
        self.assertEqual([], self.all(".explanation pre"))

    def test_the_worst_pixel_is_picked_first(self):
        self.assertIn("Pixel 3, 2: unexplained", self.text(".explanation"))
        self.open_scene(SAME)
        self.assertIn("Click a pixel", self.text(".explanation"))

    def test_arrow_keys_move_the_picked_pixel(self):
        self.find(".pane canvas").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_DOWN)
        self.wait(lambda: "x 4, y 3" in self.text(".readout"))
        self.press("w")
        self.wait(lambda: "x 3, y 2" in self.text(".readout"))

    def test_tables(self):
        side = self.text(".side")
        for expected in ("psnr\n48.25", "psnr 48.25"):
            if expected in side:
                break
        else:
            self.fail(side)
        self.assertIn("flip · mean", side)
        self.assertIn("diffuse 0.5", " ".join(side.split()))
        legend = " ".join(self.text(".legend").split())
        self.assertEqual("unexplained 3 75.0 % silhouette 1 25.0 %", legend)

    def test_the_approving_command_can_be_copied(self):
        command = "plumb regress scenes --update scenes/values.sdf --because 'WHY'"
        self.assertEqual(command, self.all(".command code")[-1].text)
        self.all(".command button")[-1].click()
        self.wait(lambda: self.all(".command button")[-1].text in ("Copied", "Press Ctrl+C"))


if __name__ == "__main__":
    unittest.main()
