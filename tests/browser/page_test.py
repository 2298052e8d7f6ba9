"""The page as a whole: nothing from a network, side files, small screens, contrast."""
import glob
import http.server
import json
import os
import re
import threading
import unittest

from support import RED_GREEN, SAME, VALUES, ReportTest


class Page(ReportTest):
    def test_contrast_in_light_and_dark(self):
        for scheme in ("light", "dark"):
            with self.subTest(scheme):
                self.resize(1440, 900, scheme)
                self.open("")
                self.find(".status-filter").click()
                self.assert_readable(25)
                self.open_scene(VALUES, "&view=side")
                self.assert_readable(50)
                self.press("?")
                self.assert_readable(60)

    def test_no_sideways_scrolling_at_390_pixels(self):
        self.resize(390, 844)
        width = "return document.documentElement.scrollWidth"
        self.open("")
        self.assertEqual(390, self.script(width))
        for view in ("slider", "side", "blink", "error"):
            self.open_scene(VALUES, f"&view={view}")
            self.assertEqual(390, self.script(width), view)
            self.assertGreater(self.find(".pane canvas").size["height"], 60)

    def test_the_sort_can_be_changed_at_390_pixels(self):
        self.resize(390, 844)
        self.assertTrue(self.find(".sort-by").is_displayed())

    def test_focus_is_visible(self):
        self.press("\ue004", "\ue004")  # tab
        style = self.script("const s = getComputedStyle(document.activeElement); return [s.outlineStyle, s.outlineWidth]")
        self.assertEqual(["solid", "2px"], style)

    def test_every_control_has_a_name(self):
        self.open_scene(VALUES, "&view=side")
        unnamed = self.script("""return [...document.querySelectorAll('button, a, input, select, canvas, [role=slider]')]
            .filter((n) => n.checkVisibility() && !(n.textContent.trim() || n.getAttribute('aria-label') || n.labels?.length))
            .map((n) => n.outerHTML)""")
        self.assertEqual([], unnamed)

    def test_licences_are_listed(self):
        self.button("About").click()
        for expected in ("d3-zoom", "d3-selection", "d3-scale-chromatic", "BSD 3-Clause", "Mike Bostock"):
            self.assertIn(expected, self.text("#about"))

    def test_licences_name_the_versions_that_are_bundled(self):
        self.button("About").click()
        listed = re.findall(r"- (d3-\S+) (\S+) \(c\)", self.text("#about"))
        self.assertGreater(len(listed), 5)
        for name, version in listed:
            with open(f"/usr/share/nodejs/{name}/package.json", encoding="utf-8") as package:
                self.assertEqual(json.load(package)["version"], version, name)

    def test_nothing_is_asked_of_a_network(self):
        self.browser.get_log("performance")
        self.open("")
        self.open_scene(VALUES, "&view=side")
        messages = [json.loads(line["message"])["message"] for line in self.browser.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        self.assertIn(self.url, urls)
        self.assertEqual([], [url for url in urls if not url.startswith(("file:", "data:"))])

    def test_the_policy_forbids_a_network(self):
        asked = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.append(self.path)
                self.send_response(204)
                self.end_headers()

        server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
        self.addCleanup(server.server_close)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.shutdown)
        blocked = self.browser.execute_async_script("""
            const [url, done] = arguments;
            const blocked = [];
            document.addEventListener('securitypolicyviolation', (e) => { blocked.push(e.effectiveDirective); });
            new Image().src = url + 'image';
            const script = document.createElement('script');
            script.src = url + 'script.js';
            document.head.append(script);
            fetch(url + 'fetch').catch(() => {}).then(() => setTimeout(() => done(blocked), 300));
            """, f"http://127.0.0.1:{server.server_port}/")
        self.assertEqual(["connect-src", "img-src", "script-src-elem"], sorted(blocked))
        self.assertEqual([], asked)
        self.browser.get_log("browser")  # the refusals are what was wanted


class SideFiles(ReportTest):
    kind = "beside"

    def test_pictures_beside_the_page_are_loaded_when_looked_at(self):
        self.assertEqual(3, len(glob.glob(self.place.name + "/pictures/*.js")))
        self.assertLess(os.path.getsize(self.place.name + "/index.html"), 300_000)
        self.open_scene(RED_GREEN)
        self.assertEqual([255, 0, 0], self.colour(0, 0.4))
        self.press("j")
        self.wait_for_scene(VALUES)
        self.assertEqual("12.5", self.readout()[0][0])
        self.press("j")
        self.wait_for_scene(SAME)

    def test_a_lost_picture_is_named(self):
        lost = next(path for path in glob.glob(self.place.name + "/pictures/2-*.js"))
        os.rename(lost, lost + ".away")
        self.addCleanup(os.rename, lost + ".away", lost)
        self.open("#scene=scenes%2Fsame.sdf")
        self.wait(lambda: os.path.basename(lost) in self.text(".notice"))
        self.browser.get_log("browser")  # the browser complains, too


if __name__ == "__main__":
    unittest.main()
