"""The pages that the commands write: every scene of each opens, without an error, at both widths."""
import json
import os
import tempfile
import unittest
from urllib.parse import quote

from support import CommandTest, ReportTest, new_browser


class Commands(CommandTest, ReportTest):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        os.makedirs(cls.place.name + "/scenes")
        os.makedirs(cls.place.name + "/others")
        os.makedirs(cls.place.name + "/images")
        for name, z in (("near", -4), ("far", -6)):
            cls.write_scene(name, z)
            cls.plumb("render", f"scenes/{name}.sdf", "-o", f"images/{name}.exr")
            cls.plumb("render", "scenes/near.sdf", "-o", f"others/{name}.exr")
        cls.plumb("regress", "scenes", "--update", "near", "--because", "looked at")
        cls.write_scene("near", -4.5)
        cls.browser = new_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        pass  # each test writes a page of its own

    def check_page(self, *words, ends_with, pictures):
        self.plumb(*words, "--report", "page", ends_with=ends_with)
        self.url = "file://" + self.place.name + "/page/index.html"
        for width in (1280, 390):
            self.resize(width, 844)
            self.open("")
            scenes = json.loads(self.script("return document.getElementById('report-data').textContent"))["scenes"]
            self.assertEqual(pictures, sum(1 for scene in scenes if scene["picture"]))
            for scene in scenes:
                with self.subTest(words=words, width=width, scene=scene["name"]):
                    if scene["picture"]:
                        self.open_scene(scene["name"])
                    else:
                        self.open("#scene=" + quote(scene["name"], safe=""))
                        self.wait(lambda: self.find("main.scene .notice").is_displayed())
                    self.assertGreater(len(self.all(".panel")), 0)
                    self.assertEqual(width, self.script("return document.documentElement.scrollWidth"))

    def test_compare_of_two_files(self):
        self.check_page("compare", "images/far.exr", "others/far.exr", "--ignore", "0,0,4,4", ends_with=1, pictures=1)

    def test_compare_of_directories(self):
        self.check_page("compare", "images", "others", ends_with=1, pictures=2)

    def test_regress(self):
        self.check_page("regress", "scenes", "--ignore", "0,0,4,4", ends_with=1, pictures=1)

    def test_verify(self):
        self.check_page("verify", "scenes/near.sdf", "scenes/far.sdf", ends_with=0, pictures=2)


if __name__ == "__main__":
    unittest.main()
