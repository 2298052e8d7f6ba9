"""The table of all scenes: filter, sort, names that are hostile, 200 scenes."""
import time
import unittest

from selenium.webdriver.common.keys import Keys

from support import RED_GREEN, SAME, VALUES, ReportTest


class Overview(ReportTest):
    def names(self):
        return self.script("return [...document.querySelectorAll('.scenes tbody a')].map((a) => a.textContent)")

    def test_the_worst_come_first(self):
        statuses = [each.text.split()[-1] for each in self.all(".scenes tbody .badge")]
        self.assertEqual(["trouble", "differs", "differs", "agrees"], statuses)

    def test_filter_by_text(self):
        self.press("/")
        self.press("VALUES")
        self.wait(lambda: self.names() == [VALUES])
        self.assertEqual("1 of 4 results", self.text(".outcome"))

    def test_filter_by_cause_and_message(self):
        search = self.find("#filter")
        search.send_keys("silhouette")
        self.assertEqual([VALUES], self.names())
        search.clear()
        search.send_keys("expected a number")
        self.assertEqual(1, len(self.names()))
        search.send_keys(" nowhere")
        self.assertEqual([], self.names())

    def test_filter_by_status(self):
        button = self.find(".status-filter[data-status=differ]")
        button.click()
        self.assertEqual("false", button.get_attribute("aria-pressed"))
        self.assertNotIn(VALUES, self.names())
        self.assertIn(SAME, self.names())
        button.click()
        self.assertIn(VALUES, self.names())

    def test_sort(self):
        head = self.find("th[data-column=max_error]")
        head.find_element("tag name", "button").click()
        self.assertEqual("descending", head.get_attribute("aria-sort"))
        self.assertEqual([RED_GREEN, VALUES, SAME], self.names()[:3])
        head.find_element("tag name", "button").click()
        self.assertEqual("ascending", head.get_attribute("aria-sort"))
        self.assertEqual([SAME, VALUES, RED_GREEN], self.names()[:3])  # what has no figure stays last

    def test_figures_and_budget(self):
        row = next(each for each in self.all(".scenes tbody tr") if VALUES in each.text)
        self.assertIn("0.5", row.text)
        self.assertIn("2 not finite", row.text)
        self.assertEqual("Pixel budget: 3 unexplained, 1 silhouette",
                         row.find_element("css selector", ".budget").get_attribute("aria-label"))

    def test_thumbnails_are_pictures(self):
        for image in self.all(".scenes img"):
            self.script("arguments[0].scrollIntoView()", image)
            self.wait(lambda: self.script("return arguments[0].naturalWidth", image) > 0)  # pylint: disable=cell-var-from-loop

    def test_hostile_names_are_text(self):
        name = next(each for each in self.names() if "hacked" in each)
        self.assertEqual("scenes/</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1>\"'\u2028&amp;.sdf",
                         name)
        next(each for each in self.all(".scenes a") if "hacked" in each.text).click()
        self.wait(lambda: self.script("return document.querySelector('h1')?.textContent") == name)
        self.assertIsNone(self.script("return window.hacked"))
        self.assertIn("<!--<script>", self.text(".side"))
        self.assertEqual([], self.all("#app img[src=x]"))

    def test_title_is_text(self):
        self.assertEqual("Report <i>of</i> tests", self.browser.title)
        self.assertEqual("Report <i>of</i> tests", self.text(".title"))

    def test_a_row_leads_to_its_scene_and_back(self):
        self.all(".scenes tbody tr")[2].find_element("css selector", "td.pictures").click()
        self.wait_for_scene(VALUES)
        self.press(Keys.ESCAPE)
        self.wait(lambda: len(self.names()) == 4)


class NewScene(ReportTest):
    """One that there is no baseline of: no figure is made up for it."""
    kind = "new"

    def test_the_overview_has_no_figures(self):
        row = next(each for each in self.all(".scenes tbody tr") if "scenes/new.sdf" in each.text)
        cells = {cell.get_attribute("data-title"): cell.text
                 for cell in row.find_elements("css selector", "td[data-title]")}
        self.assertEqual("0.25 s", cells.pop("CPU"))
        self.assertIn("differs", cells.pop("Result"))
        self.assertEqual({"–"}, set(cells.values()), cells)

    def test_the_scene_says_that_there_is_nothing_to_compare_with(self):
        next(each for each in self.all(".scenes tbody a") if each.text == "scenes/new.sdf").click()
        self.wait(lambda: self.all(".notice"))
        said = "here is nothing to compare with: no image was approved yet."
        self.assertIn(said, self.text(".notice"))
        self.assertIn("T" + said, self.text(".side [aria-label='Pixel budget']"))
        self.assertNotIn("No pixel is over", self.text("#app"))
        self.assertNotIn("error", self.text(".side [aria-label=Figures]"))
        self.assertIn("--update scenes/new.sdf", self.text(".side"))


class ManyScenes(ReportTest):
    kind = "many"

    def test_200_scenes_open_and_switch_quickly(self):
        begin = time.monotonic()
        self.open("")
        self.wait(lambda: len(self.all(".scenes tbody tr")) == 200)
        opened = time.monotonic() - begin
        self.press("j")
        self.wait_for_scene("scenes/0.sdf")
        switches = []
        for i in range(3, 18, 3):  # those that differ come first
            begin = time.monotonic()
            self.press("j")
            self.wait_for_scene(f"scenes/{i}.sdf")
            switches.append(time.monotonic() - begin)
        print(f"200 scenes: opened in {opened:.2f} s, switched in at most {max(switches):.2f} s")


if __name__ == "__main__":
    unittest.main()
