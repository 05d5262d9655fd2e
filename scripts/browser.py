"""A headless Chromium for check_book.py: windows light and dark, findings of axe-core."""

import pathlib

from selenium import webdriver


def open_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--allow-file-access-from-files"]:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))


def view(browser, width, height, scheme, media=""):
    metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media, "features": features})
    browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")


def violations(browser, axe):
    """What axe-core finds: the rule, and where."""
    browser.execute_script(pathlib.Path(axe).read_text())
    found = browser.execute_async_script("axe.run().then(arguments[0])")["violations"]
    return [(finding["id"], [node["html"][:120] for node in finding["nodes"]]) for finding in found]
