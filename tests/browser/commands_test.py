"""The pages that the commands write: every scene of each opens, without an error, at both widths."""
import json
import os
import subprocess
import tempfile
import unittest

from support import ReportTest, new_browser

SCENE = """define material matt 0.1 0.1 0.1 0.5 0.5 0.5 0.2 0.2 0.2 10
define shape sphere ball 0 0 {z} 1 matt
define light lamp 3 3 3 1 1 1 1
define camera eye 60
render eye {name}.ppm 32 24
"""


class Commands(ReportTest):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        os.makedirs(cls.place.name + "/scenes")
        os.makedirs(cls.place.name + "/others")
        os.makedirs(cls.place.name + "/images")
        for name, z in (("near", -4), ("far", -6)):
            with open(f"{cls.place.name}/scenes/{name}.sdf", "w", encoding="ascii") as file:
                file.write(SCENE.format(z=z, name=name))
            cls.plumb("render", f"scenes/{name}.sdf", "-o", f"images/{name}.exr")
        cls.plumb("render", "scenes/near.sdf", "-o", "others/far.exr")
        cls.plumb("render", "scenes/near.sdf", "-o", "others/near.exr")
        cls.plumb("regress", "scenes", "--update", "near", "--because", "looked at")
        with open(cls.place.name + "/scenes/near.sdf", "w", encoding="ascii") as file:
            file.write(SCENE.format(z=-4.5, name="near"))
        cls.browser = new_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        pass  # each test writes a page of its own

    @classmethod
    def plumb(cls, *words):
        done = subprocess.run([os.environ["PLUMB_BINARY"], *words], cwd=cls.place.name, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=120)
        if done.returncode not in (0, 1, 2):
            raise AssertionError(done.stdout.decode())

    def check_page(self, *words):
        self.plumb(*words, "--report", "page")
        self.url = "file://" + self.place.name + "/page/index.html"
        for width in (1280, 390):
            self.resize(width, 844)
            self.open("")
            scenes = json.loads(self.script("return document.getElementById('report-data').textContent"))["scenes"]
            self.assertGreater(len(scenes), 0)
            for scene in scenes:
                with self.subTest(words=words, width=width, scene=scene["name"]):
                    if "causes" in scene and scene.get("picture"):
                        self.open_scene(scene["name"])
                    else:
                        self.open("#scene=" + scene["name"])
                        self.wait(lambda: self.find("main.scene .notice").is_displayed())
                    self.assertGreater(len(self.all(".panel")), 0)
                    self.assertEqual(width, self.script("return document.documentElement.scrollWidth"))

    def test_compare_of_two_files(self):
        self.check_page("compare", "images/near.exr", "others/far.exr", "--ignore", "0,0,4,4")

    def test_compare_of_directories(self):
        self.check_page("compare", "images", "others")

    def test_regress(self):
        self.check_page("regress", "scenes", "--ignore", "0,0,4,4")

    def test_verify(self):
        self.check_page("verify", "scenes/near.sdf", "scenes/far.sdf")


if __name__ == "__main__":
    unittest.main()
