#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-2-Clause
"""report_picture.py REPORT_DIR OUT.png: takes a picture of report.html in Chromium.

The report shows its fastest growing mode. docs/report.png shows the report of the case disc_brake.
Needs Debian's packages chromium-driver and python3-selenium.
"""
import base64
import io
import sys
from pathlib import Path

from PIL import Image
from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

WIDTH, HEIGHT = 1280, 657
FEWEST_COLOURS = 100  # in the view of the mode; an empty view has few


def browser(webgl=True, **log):
    """Starts Chromium without a screen, with WebGL in software or without WebGL, and without
    animation."""
    options = webdriver.ChromeOptions()
    drawing = (
        "use-gl=angle",
        "use-angle=swiftshader",
        "enable-unsafe-swiftshader",
        "ignore-gpu-blocklist",
    )
    for word in (
        "headless=new",
        "no-sandbox",
        "disable-dev-shm-usage",
        "window-size=1280,800",
        "force-prefers-reduced-motion",
        *(drawing if webgl else ("disable-gpu", "disable-3d-apis")),
    ):
        options.add_argument("--" + word)
    options.set_capability("goog:loggingPrefs", log)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def picture_of(page):
    """The picture of a report, once its mode is drawn."""
    driver = browser()
    try:
        driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False},
        )
        driver.execute_cdp_cmd("Emulation.setScrollbarsHidden", {"hidden": True})
        driver.get(page.resolve().as_uri())
        if not driver.execute_script("return Boolean(window.Chart) && data.shapes.length > 0"):
            sys.exit(
                f"report_picture.py: {page} shows no mode: it holds no shape, or was made without"
                " its libraries"
            )
        WebDriverWait(driver, 60).until(
            lambda driver: driver.execute_script("return document.documentElement.dataset.ready")
        )
        if driver.execute_script("return Boolean(document.getElementById('noview'))"):
            sys.exit(
                f"report_picture.py: {page}:"
                f" {driver.execute_script('return document.getElementById(`noview`).textContent')}"
            )
        WebDriverWait(driver, 60).until(
            lambda driver: driver.execute_script(
                "return document.getElementById('canvas').dataset.mode"
            )
        )
        picture = Image.open(io.BytesIO(driver.get_screenshot_as_png())).convert("RGB")
        # Without the scale above it
        view = driver.execute_script(
            "return document.getElementById('canvas').toDataURL()"
        ).partition(",")[2]
    finally:
        driver.quit()
    colours = len(Image.open(io.BytesIO(base64.b64decode(view))).getcolors(1 << 24))
    if colours < FEWEST_COLOURS:
        sys.exit(
            f"report_picture.py: the view of the mode in {page} is empty: it has {colours} colours"
        )
    return picture.quantize(256, dither=Image.Dither.NONE)


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    page = Path(sys.argv[1]) / "report.html"
    if not page.is_file():
        sys.exit(
            f"report_picture.py: there is no {page}; scripts/squeal-report {sys.argv[1]} writes it"
        )
    try:
        picture_of(page).save(sys.argv[2], format="PNG", optimize=True)
    except WebDriverException as error:
        sys.exit(
            f"report_picture.py: Chromium: {(error.msg or type(error).__name__).splitlines()[0]}"
        )
    except OSError as error:
        sys.exit(f"report_picture.py: cannot write {sys.argv[2]}: {error.strerror}")
    print(sys.argv[2])


if __name__ == "__main__":
    main()
