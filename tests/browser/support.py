"""A report, opened in headless Chromium from its file."""
import os
import subprocess
import tempfile
import unittest
from urllib.parse import quote

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

RED_GREEN = "scenes/red-green.sdf"
VALUES = "scenes/values.sdf"
SAME = "scenes/same.sdf"

# What a command is given, with the place of its ball.
SCENE = """define material matt 0.1 0.1 0.1 0.5 0.5 0.5 0.2 0.2 0.2 10
define shape sphere ball 0 0 {z} 1 matt
define light lamp 3 3 3 1 1 1 1
define camera eye 60
render eye {name}.ppm 32 24
"""

# Every visible text with its contrast, WCAG 2.1, on the first ground below it that is not transparent.
CONTRASTS = """
const channel = (c) => { c /= 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
const parts = (colour) => colour.match(/[\\d.]+/g).map(Number);
const light = (colour) => { const [r, g, b] = parts(colour).map(channel); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
const ground = (node) => {
  for (; node; node = node.parentElement) {
    const colour = getComputedStyle(node).backgroundColor;
    const alpha = parts(colour)[3] ?? 1;
    if (alpha === 1) return colour;
    if (alpha !== 0) throw new Error('a ground that is half transparent: ' + node.className);
  }
  return getComputedStyle(document.documentElement).backgroundColor;
};
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
const found = [];
while (walker.nextNode()) {
  const node = walker.currentNode.parentElement;
  if (!walker.currentNode.textContent.trim() || !node.checkVisibility({checkVisibilityCSS: true}) || node.closest('script, style, .skip')) continue;
  const [a, b] = [light(getComputedStyle(node).color), light(ground(node))];
  found.push([(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), node.className + ': ' + walker.currentNode.textContent]);
}
return found;
"""


def new_browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars"):
        options.add_argument(argument)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


class CommandTest:
    """A directory, cls.place, in which commands of plumb run and scenes lie."""

    @classmethod
    def write_scene(cls, name, z):
        with open(f"{cls.place.name}/scenes/{name}.sdf", "w", encoding="ascii") as file:
            file.write(SCENE.format(z=z, name=name))

    @classmethod
    def plumb(cls, *words, ends_with=0):
        done = subprocess.run([os.environ["PLUMB_BINARY"], *words], cwd=cls.place.name, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=240,
                              env={**os.environ, "PLUMB_CACHE": cls.place.name + "/cache"})
        if done.returncode != ends_with:
            raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout.decode()}")


class ReportTest(unittest.TestCase):
    """One report and one browser for all tests of a class; each test starts at the overview."""
    kind = "few"

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        subprocess.run([os.environ["PLUMB_MAKE_REPORTS"], cls.place.name, cls.kind], check=True)
        cls.url = "file://" + cls.place.name + "/index.html"
        cls.browser = new_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.resize(1440, 900)
        self.open("")

    def tearDown(self):
        self.assertEqual([], [line for line in self.browser.get_log("browser") if line["level"] == "SEVERE"])

    def resize(self, width, height, scheme="light"):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, fragment):
        self.browser.get("about:blank")  # another fragment alone would not load the page again
        self.browser.get(self.url + fragment)

    def open_scene(self, name, more=""):
        self.open("#scene=" + quote(name, safe="") + more)
        self.wait_for_scene(name)

    def wait_for_scene(self, name):
        self.wait(lambda: self.script("return document.querySelector('main.scene')?.dataset.ready") == name)
        self.wait(lambda: self.script("return document.querySelector('.pane canvas')?.dataset.transform"))

    def wait(self, condition, seconds=60):
        return WebDriverWait(self.browser, seconds, poll_frequency=0.05).until(lambda _: condition())

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.find(selector).text

    def press(self, *keys):
        ActionChains(self.browser).send_keys(*keys).perform()

    def assert_readable(self, least_texts):
        found = self.script(CONTRASTS)
        self.assertGreater(len(found), least_texts, "the test sees too few texts to mean anything")
        self.assertEqual([], [(round(contrast, 2), text) for contrast, text in found if contrast < 4.5])

    def button(self, label):
        return next(each for each in self.all("button") if each.text == label and each.is_displayed())

    def transforms(self):
        """(scale, x, y) of every pane."""
        texts = self.script("return [...document.querySelectorAll('.pane canvas')].map((c) => c.dataset.transform)")
        return [tuple(float(number) for number in text.split()) for text in texts]

    def colour(self, pane, fraction_x, fraction_y=0.5):
        """r g b on the screen, at fractions of a pane, after what is under way was drawn."""
        return self.browser.execute_async_script("""
            const [pane, x, y, done] = arguments;
            requestAnimationFrame(() => requestAnimationFrame(() => {
              const canvas = document.querySelectorAll('.pane canvas')[pane];
              done([...canvas.getContext('2d').getImageData(x * canvas.width, y * canvas.height, 1, 1).data].slice(0, 3));
            }));""", pane, fraction_x, fraction_y)

    def to_pixel(self, x, y, pane=0):
        """Moves the pointer over a pixel of the picture; returns the actions, to be gone on with."""
        canvas = self.all(".pane canvas")[pane]
        scale, left, top = self.transforms()[pane]
        size = canvas.size
        offset_x = round(left + scale * (x + 0.5) - size["width"] / 2)
        offset_y = round(top + scale * (y + 0.5) - size["height"] / 2)
        return ActionChains(self.browser).move_to_element_with_offset(canvas, offset_x, offset_y)

    def readout(self):
        """[[reference, test, difference] of R, G, B]"""
        return [[cell.text for cell in row.find_elements(By.TAG_NAME, "td")] for row in self.all(".readout tbody tr")]
