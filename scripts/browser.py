"""Looks at pages in a headless Chromium: python browser.py PAGE... [--into FOLDER] [--head FILE]

Takes a picture (into FOLDER, else beside the page) at 1280 and 400 pixels, light and dark, and one as printed
on A4. Fails on messages of the console, on requests beside the page's own, where an element is wider than its
column, where a figure is missing, and where a text stands outside its picture or covers another, in the SVG
files of its folder too.
"""

import argparse
import base64
import json
import pathlib
import sys

from selenium import webdriver

FAULTS = """
const faults = [], width = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth > width) faults.push("wider than the window");
document.querySelectorAll("details").forEach((details) => (details.open = true));
const shown = (element) => element.checkVisibility();
for (const element of document.querySelectorAll("body *:not(svg *)")) {
    if (!shown(element) || element.closest("thead") || element.closest("svg")) continue;
    const box = element.getBoundingClientRect(), parent = element.parentElement.getBoundingClientRect();
    if (box.right > parent.right + 1.5 && element.closest(".scroll") === null)
        faults.push(`${element.tagName}.${element.className} is ${Math.round(box.right - parent.right)} px wider than its column`);
    if (element.matches(".scroll") && element.scrollWidth > element.clientWidth + 1)
        faults.push(`a table is cut: ${element.scrollWidth} of ${element.clientWidth} px`);
}
for (const figure of document.querySelectorAll("figure")) {
    if (!shown(figure)) continue;
    const pictures = [...figure.querySelectorAll("svg[role]")].filter(shown);
    if (pictures.length !== 1 || pictures[0].getBoundingClientRect().height < 40) faults.push("a figure is missing");
}
for (const picture of document.querySelectorAll("svg[role], svg:root")) {
    if (!shown(picture)) continue;
    const name = picture.getAttribute("aria-label") ?? "its file";
    const frame = picture.getBoundingClientRect(), texts = [...picture.querySelectorAll("text")];
    const boxes = texts.map((text) => [text.textContent, text.getBoundingClientRect()]);
    for (const [words, box] of boxes)
        if (box.left < frame.left - 2 || box.right > frame.right + 2 || box.top < frame.top - 2 || box.bottom > frame.bottom + 2)
            faults.push(`'${words}' stands outside ${name}`);
    boxes.forEach(([words, box], at) => boxes.slice(at + 1).forEach(([other, its]) => {
        const across = Math.min(box.right, its.right) - Math.max(box.left, its.left);
        const down = Math.min(box.bottom, its.bottom) - Math.max(box.top, its.top);
        if (across > 3 && down > 4) faults.push(`'${words}' covers '${other}' in ${name}`);
    }));
}
for (const element of document.querySelectorAll("h1, summary, td:first-child, text"))
    if (element.textContent.trim() === "structure") faults.push("an object is called structure");
if (document.querySelectorAll("figure, svg[role], svg:root").length === 0) faults.push("no figure at all");
document.querySelectorAll("details").forEach((details) => (details.open = false));
return faults;
"""

parser = argparse.ArgumentParser()
parser.add_argument("pages", nargs="+", type=pathlib.Path)
parser.add_argument("--into", type=pathlib.Path)
parser.add_argument("--head", type=pathlib.Path, help="picture of the head of the first page")
arguments = parser.parse_args()
options = webdriver.ChromeOptions()
options.binary_location = "/usr/bin/chromium"
for argument in ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--disable-background-networking"]:
    options.add_argument(argument)
options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
browser = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
# A scroll bar, which the picture does not show, would cut the right margin off.
command, faults = browser.execute_cdp_cmd, []
command("Emulation.setScrollbarsHidden", {"hidden": True})
picture = lambda whole: command("Page.captureScreenshot", {"captureBeyondViewport": whole})["data"]
shot = lambda whole: base64.b64decode(picture(whole))
for page in (page.resolve() for page in arguments.pages):
    folder = arguments.into or page.parent
    for width, scheme in [(400, "light"), (400, "dark"), (1280, "dark"), (1280, "light")]:
        metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        command("Emulation.setDeviceMetricsOverride", metrics)
        scheme_is = {"name": "prefers-color-scheme", "value": scheme}
        command("Emulation.setEmulatedMedia", {"features": [scheme_is]})
        browser.get(page.as_uri())
        found = [f"{page.name}, {width} px: {fault}" for fault in browser.execute_script(FAULTS)]
        faults += [fault for fault in found if fault not in faults]
        faults += [f"{page.name}, {width} px, {scheme}: {entry['message']}" for entry in browser.get_log("browser")]
        for entry in browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if url != page.as_uri() and not url.startswith("data:"):
                    faults.append(f"{page.name}: asks for {url}")
        (folder / f"{page.stem}-{width}-{scheme}.png").write_bytes(shot(True))
    if arguments.head and page == arguments.pages[0].resolve():
        arguments.head.write_bytes(shot(False))
    printed = command("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True})["data"]
    (folder / f"{page.stem}-print.pdf").write_bytes(base64.b64decode(printed))
    for file in sorted(page.with_suffix("").glob("*.svg")):
        browser.get(file.as_uri())
        faults += [f"{file.name}: {fault}" for fault in browser.execute_script(FAULTS)]
    # Requests of these files are not the next page's.
    browser.get_log("performance")
browser.quit()
sys.exit("\n".join(faults) or None)
