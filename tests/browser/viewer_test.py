"""The pictures of one scene: slider, blink, side by side, error, zoom, exposure, keys."""
import time
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from support import RED_GREEN, SAME, VALUES, ReportTest

RED = [255, 0, 0]
GREEN = [0, 255, 0]


class Viewer(ReportTest):
    def shows(self):
        return self.find(".pane").get_attribute("data-shows")

    def test_the_slider_parts_reference_and_test(self):
        self.open_scene(RED_GREEN)
        self.assertEqual((RED, GREEN), (self.colour(0, 0.4), self.colour(0, 0.6)))
        width = self.find(".pane").size["width"]
        ActionChains(self.browser).drag_and_drop_by_offset(self.find(".divider"), round(-0.2 * width), 0).perform()
        self.assertEqual((RED, GREEN), (self.colour(0, 0.27), self.colour(0, 0.4)))

    def test_the_slider_moves_by_keys(self):
        self.open_scene(RED_GREEN)
        divider = self.find(".divider")
        divider.send_keys(Keys.HOME)
        self.assertEqual(GREEN, self.colour(0, 0.3))
        divider.send_keys(Keys.END)
        self.assertEqual(RED, self.colour(0, 0.7))
        divider.send_keys(Keys.ARROW_LEFT)
        self.assertEqual("98", divider.get_attribute("aria-valuenow"))

    def test_blink_shows_both_in_turn_until_paused(self):
        self.open_scene(RED_GREEN)
        self.press("3")
        seen = set()

        def look():
            before, colour = self.shows(), self.colour(0, 0.5)
            if before == self.shows():  # else it blinked between the two looks
                seen.add((before, *colour))
            return len(seen) == 2
        self.wait(look)
        self.assertEqual({("reference", *RED), ("test", *GREEN)}, seen)
        self.button("Pause").click()
        before = self.shows()
        time.sleep(1.5)
        self.assertEqual(before, self.shows())
        self.script("document.activeElement.blur()")
        self.press(" ")
        self.wait(lambda: self.shows() != before)

    def test_side_by_side(self):
        self.open_scene(RED_GREEN, "&view=side")
        self.assertEqual([RED, GREEN], [self.colour(0, 0.5), self.colour(1, 0.5)])
        self.assertEqual([252, 255, 164], self.colour(2, 0.5))  # inferno's last colour: an error of 1

    def test_zoom_and_pan_are_one_for_all_panes(self):
        self.open_scene(RED_GREEN, "&view=side")
        fitting = self.transforms()
        self.assertEqual(3, len(fitting))
        canvas = self.all(".pane canvas")[1]
        ActionChains(self.browser).move_to_element(canvas).perform()
        self.script("""const box = arguments[0].getBoundingClientRect();
            arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: -300, bubbles: true, cancelable: true,
              clientX: box.left + 30, clientY: box.top + 200}))""", canvas)
        self.wait(lambda: self.transforms() != fitting)
        zoomed = self.transforms()
        self.assertEqual(1, len(set(zoomed)))
        self.assertGreater(zoomed[0][0], fitting[0][0])
        third = self.all(".pane canvas")[2]
        ActionChains(self.browser).drag_and_drop_by_offset(third, 40, 0).perform()
        self.wait(lambda: self.transforms() != zoomed)
        moved = self.transforms()
        self.assertEqual(1, len(set(moved)))
        self.assertEqual(zoomed[0][0], moved[0][0])
        self.assertAlmostEqual(zoomed[0][1] + 40, moved[0][1], delta=1e-6)
        ActionChains(self.browser).drag_and_drop_by_offset(self.all(".pane canvas")[0], 5, 0).perform()
        self.wait(lambda: abs(self.transforms()[2][1] - moved[2][1] - 5) < 1e-6)  # the first goes on where the third stopped

    def test_keys_zoom_and_fit(self):
        self.open_scene(RED_GREEN)
        fitting = self.transforms()[0]
        self.press("+")
        self.wait(lambda: self.transforms()[0][0] > fitting[0])
        self.press("0")
        self.wait(lambda: self.transforms()[0] == fitting)

    def test_exposure_makes_hdr_readable(self):
        self.open_scene(SAME)
        self.press("s")  # values as they are
        self.assertEqual([51, 102, 153], self.colour(0, 0.3))
        self.press("d", "d")  # one stop down
        self.assertEqual("−1 EV", self.text(".stops"))
        for found, expected in zip(self.colour(0, 0.3), [25.5, 51, 76.5]):
            self.assertAlmostEqual(found, expected, delta=0.51)
        self.press("r")
        self.assertEqual([51, 102, 153], self.colour(0, 0.3))
        self.press("s")
        self.assertEqual([124, 170, 203], self.colour(0, 0.3))  # IEC 61966-2-1 of 0.2 0.4 0.6

    def test_pixels_that_are_not_finite_are_chequered(self):
        self.open_scene(VALUES, "&view=error")
        scale, left, top = self.transforms()[0]
        size = self.find(".pane canvas").size
        at = lambda x, y: self.colour(0, (left + scale * (x + 0.5)) / size["width"], (top + scale * (y + 0.5)) / size["height"])
        self.assertEqual([[0, 0, 0], [255, 0, 255]], sorted([at(7, 6), at(8, 6)]))

    def test_the_scale_is_shown_with_numbers(self):
        self.open_scene(VALUES, "&view=error")
        self.assertEqual(["≤ 1e-8", "1"], [self.all(".ticks span")[i].text for i in (0, -1)])
        self.button("Own range").click()
        self.assertEqual(["≤ 1e-6", "1"], [self.all(".ticks span")[i].text for i in (0, -1)])

    def test_next_and_previous_follow_the_table(self):
        self.open_scene(RED_GREEN)
        self.press("j")
        self.wait_for_scene(VALUES)
        self.press("k")
        self.wait_for_scene(RED_GREEN)

    def test_the_address_leads_to_a_pixel_in_a_view(self):
        self.open_scene(VALUES, "&view=error&pixel=20,10")
        self.assertEqual("error", self.shows())
        self.assertIn("x 20, y 10", self.text(".readout"))
        self.press("2")
        self.assertIn("view=side", self.browser.current_url)

    def test_help_lists_the_keys_and_can_turn_them_off(self):
        self.open_scene(RED_GREEN)
        self.press("?")
        self.assertTrue(self.find("#help").is_displayed())
        self.assertIn("next scene", self.text("#help"))
        self.find("#has-shortcuts").click()
        self.press(Keys.ESCAPE)
        self.press("4")
        self.assertEqual("reference test", self.shows())


class OneScene(ReportTest):
    kind = "one"

    def test_the_only_scene_is_shown_at_once(self):
        self.wait_for_scene(RED_GREEN)
        self.assertEqual(RED_GREEN, self.text("h1"))

    def test_of_one_scene_there_is_no_overview(self):
        for fragment in ("", "#scene=another"):
            self.open(fragment)
            self.wait_for_scene(RED_GREEN)
            self.assertNotIn("Overview", self.text("#app"))
            self.assertEqual([], self.all(".steps, .scenes"))
        self.press("o", "j")
        self.wait_for_scene(RED_GREEN)


if __name__ == "__main__":
    unittest.main()
