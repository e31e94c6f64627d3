#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The documentation site, built by scripts/docs, and the README: test_site.py PROGRAM."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

repository = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
# What a browser loads by itself. A link that a reader may follow (`a`) is not loaded.
LOADED = {
    "script": ["src"],
    "img": ["src", "srcset"],
    "source": ["src", "srcset"],
    "iframe": ["src"],
    "video": ["src", "poster"],
    "audio": ["src"],
    "embed": ["src"],
    "object": ["data"],
    "image": ["href", "xlink:href"],
    "use": ["href", "xlink:href"],
    "link": ["href"],
}
NETWORK = re.compile(r"^(?!data:)([a-z][a-z0-9+.-]*:|//)", re.I)


class Page(HTMLParser):
    """Names of places, links, and what is loaded, of one page."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links, self.loaded, self.styles, self.in_style = set(), [], [], [], False
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.in_style = tag == "style"
        self.places.update(values[key] for key in ("id", "name") if values.get(key))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        for key in LOADED.get(tag, []):
            if values.get(key):
                self.loaded += (
                    [part.split()[0] for part in values[key].split(",")]
                    if key == "srcset"
                    else [values[key]]
                )
        if values.get("style"):
            self.styles.append(values["style"])

    def handle_data(self, data):
        if self.in_style:
            self.styles.append(data)


def addresses_of_style(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    return [
        found[1] or found[2]
        for found in re.finditer(r"url\(\s*[\"']?([^\"')]+)|@import\s+[\"']([^\"']+)", text)
    ]


def headings(path):
    """Names of the places in a Markdown file, as repositories and the site give them."""
    text = re.sub(r"^```.*?^```", "", path.read_text(), flags=re.M | re.S)
    found = [
        re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
        for title in re.findall(r"^#+ (.*)", text, re.M)
    ]
    return set(found)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.site = Path(cls.temporary.name).resolve() / "site"
        built = subprocess.run(
            [repository / "scripts/docs", cls.site], capture_output=True, text=True
        )
        if built.returncode:
            raise AssertionError(
                f"scripts/docs: exit code {built.returncode}\n{built.stdout}{built.stderr}"
            )
        cls.pages = {path: Page(path) for path in sorted(cls.site.rglob("*.html"))}

    def at(self, page, address):
        """The file that an address on a page means."""
        path = unquote(urlsplit(address).path)
        return (page.parent / path).resolve() if path else page

    def test_every_page_of_docs_is_there_and_in_the_navigation(self):
        wanted = {
            self.site / path.relative_to(repository).with_suffix(".html")
            for path in (repository / "docs").glob("*.md")
        }
        self.assertGreaterEqual(len(wanted), 12)
        self.assertEqual(wanted - self.pages.keys(), set())
        start = self.site / "docs/index.html"
        linked = {
            self.at(start, link) for link in self.pages[start].links if not NETWORK.match(link)
        }
        self.assertEqual(wanted - linked, set())

    def test_every_link_and_picture_resolves_within_the_site(self):
        count = 0
        for path, page in self.pages.items():
            for link in page.links + page.loaded:
                if NETWORK.match(link) or link.startswith("data:"):
                    continue
                with self.subTest(page=path.relative_to(self.site), link=link):
                    target = self.at(path, link)
                    self.assertTrue(target.is_file(), "there is no such file")
                    self.assertTrue(target.is_relative_to(self.site), "it leads out of the site")
                    place = unquote(urlsplit(link).fragment)
                    if place and target in self.pages:
                        self.assertIn(
                            place, self.pages[target].places, "the page has no such place"
                        )
                    count += 1
        self.assertGreater(count, 500)

    def test_nothing_is_loaded_from_the_network(self):
        for path, page in self.pages.items():
            styles = [address for text in page.styles for address in addresses_of_style(text)]
            self.assertEqual(
                [address for address in page.loaded + styles if NETWORK.match(address)], [], path
            )
        styles = list(self.site.rglob("*.css"))
        self.assertTrue(styles)
        for path in styles:
            for address in addresses_of_style(path.read_text()):
                self.assertIsNone(NETWORK.match(address), f"{path}: {address}")
                if not address.startswith("data:"):
                    self.assertTrue(self.at(path, address).is_file(), f"{path}: {address}")

    def test_a_browser_shows_every_page_and_sets_the_formulas(self):
        options = webdriver.ChromeOptions()
        for word in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "window-size=1280,800"):
            options.add_argument("--" + word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.addCleanup(driver.quit)
        formulas = 0
        for path in self.pages:
            if path == self.site / "index.html":
                continue  # it leads on to the start page at once
            driver.get(path.as_uri())
            self.assertGreater(
                driver.execute_script("return document.body.innerText.length"), 100, path
            )
            broken = driver.execute_script(
                "return Array.from(document.images).filter((i) => !i.naturalWidth).map((i) =>"
                " i.src)"
            )
            self.assertEqual(broken, [], path)
            # A formula that KaTeX does not understand stays in the class katex-error.
            counts = driver.execute_script(
                "const n = (s) => document.querySelectorAll(s).length; return [n('.math'), n('.math"
                " > .katex, .math > .katex-display'), n('.katex-error')];"
            )
            self.assertEqual(counts, [counts[0], counts[0], 0], path)
            formulas += counts[0]
            for width in (1280, 600):  # on a narrow screen the navigation stands above the text
                driver.set_window_size(width, 800)
                wider = driver.execute_script(
                    "return document.documentElement.scrollWidth - innerWidth"
                )
                self.assertLessEqual(wider, 0, f"{path} is wider than a window of {width}")
        self.assertGreater(formulas, 300)
        driver.get((self.site / "search.html").as_uri() + "?q=caliper")
        results = (  # they come one after the other
            "return document.querySelectorAll('#search-results li a').length"
        )
        WebDriverWait(driver, 10).until(lambda _: driver.execute_script(results) > 2)
        events = [
            json.loads(entry["message"])["message"] for entry in driver.get_log("performance")
        ]
        asked = {
            event["params"]["request"]["url"]
            for event in events
            if event["method"] == "Network.requestWillBeSent"
        }
        self.assertGreater(len(asked), len(self.pages))
        self.assertEqual(
            [url for url in asked if not url.startswith((self.site.as_uri(), "data:", "blob:"))], []
        )
        self.assertEqual(driver.get_log("browser"), [])


class Texts(unittest.TestCase):
    """What pages and README say of the repository and of the program is so."""

    texts = sorted((repository / "docs").glob("*.md")) + [repository / "README.md"]

    def test_the_links_of_the_readme_resolve(self):
        links = re.findall(r"\]\(([^)\s]+)\)", (repository / "README.md").read_text())
        self.assertGreater(len(links), 10)
        for link in links:
            if NETWORK.match(link):
                continue
            with self.subTest(link=link):
                path, _, place = link.partition("#")
                target = repository / (path or "README.md")
                self.assertTrue(target.is_file())
                if place:
                    self.assertIn(place, headings(target))

    def test_the_readme_is_short_and_warns_of_code(self):
        text = (repository / "README.md").read_text()
        self.assertLessEqual(len(text.splitlines()), 95)
        self.assertLessEqual(max(len(line) for line in text.splitlines()), 150)
        self.assertRegex(text, r"`\.geo`[^.]*\*\*(are|is) code\*\*")
        self.assertIn("SystemCall", text)

    def test_options_are_those_of_the_program(self):
        manual = json.loads(
            subprocess.run(
                [PROGRAM, "-help_json"], check=True, capture_output=True, text=True
            ).stdout
        )
        patterns = [
            re.sub("<[^>]*>", "[a-z0-9_<>…]+", option["name"]) for option in manual["options"]
        ]
        patterns += [
            re.sub("<[^>]*>", "[a-z0-9_<>…]+", solver["prefix"]) + ".*"
            for solver in manual["solvers"]
        ]
        known = re.compile("|".join(f"({pattern})" for pattern in patterns))
        prefixes = {
            word
            for option in manual["options"]
            for word in [option["name"].split("_")[0]]
            if "_" in option["name"]
        }
        found = {}
        for path in self.texts:
            # What ends with `_` or `*` is a prefix.
            for name in re.findall(
                r"(?<![\w/.…-])-((?:%s)_[a-z0-9_<>]*[a-z0-9>])(?![\w<*])(?!_)"
                % "|".join(sorted(prefixes)),
                path.read_text(),
            ):
                found.setdefault(name, path.name)
        self.assertGreater(len(found), 100)
        self.assertEqual(
            {name: page for name, page in found.items() if not known.fullmatch(name)}, {}
        )

    def test_files_of_the_repository_that_are_named_are_there(self):
        folders = "scripts|options|meshes|src|tests|python|docs|web|packaging"
        found = {}
        for path in self.texts:
            for name in re.findall(rf"(?<![\w/.-])((?:{folders})/[\w./-]*\w)", path.read_text()):
                found.setdefault(name, path.name)
        self.assertGreater(len(found), 20)
        self.assertEqual(
            {name: page for name, page in found.items() if not (repository / name).exists()}, {}
        )


if __name__ == "__main__":
    unittest.main()
