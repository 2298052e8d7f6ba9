"""The pages of all commands that write one: one look, in every size and scheme."""
import json
import os
import shutil
import tempfile
import unittest

from support import CommandTest, ReportTest, new_browser

LEVELS = (100, 150, 200)
LONG_NAME = "z" * 63

# The name of each page, what writes it, with which exit code, and the file.
PAGES = (
    ("verify", ("verify", "scenes/near.sdf", "scenes/far.sdf", "--report", "verify"), 0, "verify/index.html"),
    ("compare", ("compare", "grey.ppm", "brighter.ppm", "--report", "compare"), 1, "compare/index.html"),
    ("regress", ("regress", "scenes", "--report", "regress"), 1, "regress/index.html"),
    ("faults", ("faults", "--report", "faults"), 0, "faults/index.html"),
    ("diagnose", ("diagnose", "scenes/near.sdf", "class/swapped/near.ppm", "--report", "diagnose"), 1,
     "diagnose/diagnose.html"),
    ("judge", ("judge", "--images", "class", "--scenes", "scenes", "--report", "judge"), 1, "judge/index.html"),
    ("a submission", (), 0, "judge/submission-2.html"),
    ("lessons", (), 0, "judge/faults.html"),
    ("atlas", ("stability", "--quick", "--condition", "flattening", "--report", "atlas"), 0, "atlas/stability.html"),
)


class Pages(CommandTest, ReportTest):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        for folder in ("scenes", "class/right", "class/swapped", f"class/{LONG_NAME}"):
            os.makedirs(f"{cls.place.name}/{folder}")
        for name, z in (("near", -4), ("far", -6)):
            cls.write_scene(name, z)
            cls.plumb("render", f"scenes/{name}.sdf", "-o", f"class/right/{name}.ppm")
            cls.plumb("render", f"scenes/{name}.sdf", "--fault", "ka-kd-swapped", "-o", f"class/swapped/{name}.ppm")
            shutil.copy(f"{cls.place.name}/class/right/{name}.ppm", f"{cls.place.name}/class/{LONG_NAME}")
        for name, levels in (("grey", LEVELS), ("brighter", [level + 20 for level in LEVELS])):
            with open(f"{cls.place.name}/{name}.ppm", "wb") as file:
                file.write(b"P6 32 24 255\n" + bytes(levels) * 32 * 24)
        for _, words, ends_with, _ in PAGES:
            if words:
                cls.plumb(*words, ends_with=ends_with)
        cls.browser = new_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        pass  # each test opens the pages that it looks at

    def of_each_page(self, width, scheme="light"):
        self.resize(width, 900, scheme)
        for name, _, _, file in PAGES:
            self.url = f"file://{self.place.name}/{file}"
            self.open("")
            self.wait(lambda: self.all("main"))
            yield name

    def test_no_page_scrolls_sideways(self):
        for width in (1280, 390):
            for name in self.of_each_page(width):
                self.assertEqual(width, self.script("return document.documentElement.scrollWidth"), name)
                self.assertEqual(1, len(self.all("meta[name=viewport]")), name)

    def test_a_long_name_leaves_room_for_verdicts(self):
        self.resize(390, 900, "light")
        self.url = f"file://{self.place.name}/judge/index.html"
        self.open("")
        widths = self.script("return [...document.querySelectorAll('tbody th')].map((n) => n.offsetWidth)")
        self.assertEqual(3, len(widths))
        self.assertLess(max(widths), 0.5 * 390)
        self.assertEqual("4 of 6 pictures are right; known mistakes explain 2.", self.find(".conclusion").text)

    def test_every_page_begins_with_its_conclusion(self):
        for name in self.of_each_page(390):
            first = self.script("""const walker = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT,
                (n) => n.textContent.trim() ? NodeFilter.FILTER_ACCEPT : NodeFilter.FILTER_SKIP);
                return walker.nextNode().parentElement.closest('.conclusion')?.textContent ?? ''""")
            self.assertRegex(first, r"^\S.{10,}\.$", name)
            self.assertTrue(self.find(".conclusion").is_displayed(), name)

    def test_every_page_is_readable_in_light_and_dark(self):
        grounds = {}
        for scheme in ("light", "dark"):
            for name in self.of_each_page(1280, scheme):
                self.assert_readable(10)
                ground = self.script("return getComputedStyle(document.body).backgroundColor")
                self.assertNotEqual(ground, grounds.get(name))
                grounds[name] = ground
        self.assertEqual(len(PAGES), len(grounds))

    def test_all_pages_have_one_style_sheet_and_ask_for_nothing(self):
        styles = set()
        self.browser.get_log("performance")
        for name in self.of_each_page(1280):
            self.assertTrue(self.browser.title, name)
            self.assertEqual("en", self.script("return document.documentElement.lang"), name)
            sheets = self.script("return [...document.querySelectorAll('style, link[rel=stylesheet]')].map((n) => n.textContent)")
            self.assertEqual(1, len(sheets), name)
            styles.add(sheets[0])
        self.assertEqual(1, len(styles))
        messages = [json.loads(line["message"])["message"] for line in self.browser.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        self.assertGreater(len(urls), len(PAGES))
        self.assertEqual([], [url for url in urls if not url.startswith(("file:", "data:", "about:"))])

    def test_every_picture_says_what_it_shows(self):
        pictures = 0
        for name in self.of_each_page(1280):
            unsaid = self.script("""return [...document.querySelectorAll('img, canvas, svg')].filter((n) => n.checkVisibility() &&
                !(n.alt || n.getAttribute('aria-label') || n.getAttribute('aria-hidden'))).map((n) => n.outerHTML.slice(0, 200))""")
            self.assertEqual([], unsaid, name)
            pictures += len(self.all("img, canvas"))
        self.assertGreater(pictures, 300)

    def test_pictures_go_by_the_same_words(self):
        for name in self.of_each_page(1280):
            if name in ("diagnose", "faults", "a submission", "lessons"):
                captions = [each.text for each in self.all(".figures figcaption")]
                self.assertGreater(len(captions), 0, name)
                for at, word in enumerate(("right", "yours", "difference")):
                    self.assertEqual([], [caption for caption in captions[at::3] if not caption.startswith(word)], name)
            if name == "compare":
                self.press("2")
                self.assertEqual(["Right", "Yours", "Difference"], [each.text for each in self.all(".chip")])

    def test_files_of_8_bits_are_shown_as_they_are(self):
        self.resize(1280, 900)
        self.url = f"file://{self.place.name}/compare/index.html"
        self.open_scene("brighter.ppm", "&view=side")
        self.assertEqual([list(LEVELS), [level + 20 for level in LEVELS]], [self.colour(0, 0.5), self.colour(1, 0.5)])
        self.press("s")
        self.assertEqual(list(LEVELS), self.colour(0, 0.5))
        self.assertIn("As in the files", self.text(".toolbar"))


if __name__ == "__main__":
    unittest.main()
