"""Looks at a page in a headless Chromium: python browser.py PAGE [FOLDER]

Takes a picture (into FOLDER, else beside the page) at 1280 and 400 pixels, light and dark. Fails on messages of the
console, and where the page is wider than the window.
"""

import base64
import pathlib
import sys

from selenium import webdriver

page = pathlib.Path(sys.argv[1]).resolve()
folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else page.parent
options = webdriver.ChromeOptions()
options.binary_location = "/usr/bin/chromium"
for argument in ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu"]:
    options.add_argument(argument)
options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
browser = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
faults = []
for width, scheme in [(1280, "light"), (1280, "dark"), (400, "light"), (400, "dark")]:
    metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    browser.get(page.as_uri())
    if browser.execute_script("return document.documentElement.scrollWidth") > width:
        faults.append(f"{width} px: wider than the window")
    faults += [f"{width} px, {scheme}: {entry['message']}" for entry in browser.get_log("browser")]
    picture = browser.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True})["data"]
    (folder / f"{page.stem}-{width}-{scheme}.png").write_bytes(base64.b64decode(picture))
browser.quit()
sys.exit("\n".join(faults) or None)
