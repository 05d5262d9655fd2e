"""Looks at a report in a headless Chromium: python check_report.py ROCKFRAG RUN REPORT AXE [SCREENSHOTS]

No error in the console and nothing fetched, every figure there with text that can be selected, its SVG, PNG and CSV made by the
page alone, the calculator's answers equal to those of `evaluate`, the keyboard enough, nothing cut without a word in a window
of 400 pixels, a few pages on paper, and no finding of axe-core, light and dark.
"""

import base64
import csv
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

import browser as chromium
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

rockfrag, run, report, axe = sys.argv[1:5]
screenshots = pathlib.Path(sys.argv[5]) if len(sys.argv) > 5 else None
ANSWERS = ["p_nr", "p_ex", "p_ro", "p_f_r", "p_f"]
QUESTIONS = 20
PAGES = 12


def view(width, height, scheme, media=""):
    chromium.view(browser, width, height, scheme, media)


def screenshot(name):
    if screenshots is None:
        return
    screenshots.mkdir(parents=True, exist_ok=True)
    picture = browser.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True})
    (screenshots / f"{name}.png").write_bytes(base64.b64decode(picture["data"]))


def check_network():
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    foreign = [url[:100] for url in asked if not url.startswith(("data:", "blob:", pathlib.Path(report).resolve().as_uri()))]
    assert not foreign, f"the page asks for {foreign}"


def open_folds():
    browser.execute_script("document.querySelectorAll('details').forEach((fold) => (fold.open = true))")


def check_figures():
    figures = browser.find_elements(By.CSS_SELECTOR, "figure")
    assert len(figures) >= 3, f"only {len(figures)} figures"
    for figure in figures:
        name = figure.get_attribute("id")
        size = figure.find_element(By.TAG_NAME, "svg").size
        assert size["width"] > 100 and size["height"] > 50, f"{name} is {size}"
        assert figure.find_element(By.TAG_NAME, "figcaption").text, f"{name} has no caption"
        selected = "const s = getSelection(); s.selectAllChildren(arguments[0].querySelector('svg')); const t = s.toString(); s.removeAllRanges(); return t"
        assert browser.execute_script(selected, figure).strip(), f"the text of {name} cannot be selected"
        for link in figure.find_elements(By.CSS_SELECTOR, ".files a"):
            file = pathlib.Path(report).parent / link.get_dom_attribute("href")
            assert file.stat().st_size > 500, f"{file} is empty"
    for canvas in browser.find_elements(By.TAG_NAME, "canvas"):
        drawn = "const c = arguments[0]; return c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some(Boolean)"
        assert browser.execute_script(drawn, canvas), "an empty canvas"
    return len(figures)


def table(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def check_alone():
    """The page in a folder by itself, as it comes by mail: its files are those that the command wrote."""
    folder = pathlib.Path(tempfile.mkdtemp())
    page = shutil.copy(report, folder / "page.html")
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
    browser.get(pathlib.Path(page).as_uri())
    open_folds()
    beside = pathlib.Path(report).with_suffix("")
    names = [figure.get_attribute("id").removeprefix("figure-") for figure in browser.find_elements(By.TAG_NAME, "figure")]
    for name in [*names[:3], names[-1]]:
        # Chromium drops what a page starts beyond ten downloads in a second.
        time.sleep(1)
        for kind in ["svg", "png", "csv"]:
            browser.execute_script("arguments[0].click()", browser.find_element(By.CSS_SELECTOR, f"#figure-{name} .files a[download$={kind}]"))
            made = folder / f"{name}.{kind}"
            for _ in range(100):
                if made.exists() and made.stat().st_size and not list(folder.glob("*.crdownload")):
                    break
                time.sleep(0.1)
            assert made.exists(), f"the page alone gives no {made.name}"
        here, there = table(folder / f"{name}.csv"), table(beside / f"{name}.csv")
        assert len(here) == len(there), f"{name}.csv has {len(here)} rows, expected {len(there)}"
        for one, other in zip(here[1:], there[1:]):
            for a, b in zip(one, other):
                close = a == b or (a and b and abs(float(a) - float(b)) <= 2e-3 * abs(float(b)) + 1e-3)
                assert close, f"{name}.csv: {one}, expected {other}"
        words = [(folder / f"{name}.svg").read_text(), (beside / f"{name}.svg").read_text()]
        assert "var(" not in words[0] and words[0].count("<text") == words[1].count("<text") > 0, f"{name}.svg"
        sizes = [path.read_bytes()[16:24] for path in (folder / f"{name}.png", beside / f"{name}.png")]
        assert sizes[0] == sizes[1], f"{name}.png has another size"
    shutil.rmtree(folder)
    browser.get(pathlib.Path(report).resolve().as_uri())
    browser.execute_async_script("document.fonts.ready.then(() => setTimeout(arguments[0], 300))")


def check_hover():
    """Pointing at each of many places of the first figure tells of a point somewhere."""
    picture = browser.find_element(By.CSS_SELECTOR, "figure svg")
    script = """const box = arguments[0].getBoundingClientRect();
        for (let k = 0; k < 2500; k++) {
            const [x, y] = [box.left + (k % 50) / 50 * box.width, box.top + Math.floor(k / 50) / 50 * box.height];
            arguments[0].dispatchEvent(new PointerEvent('pointermove', {clientX: x, clientY: y}));
            const tip = document.getElementById('tip');
            if (tip.hidden) continue;
            const told = tip.textContent;
            arguments[0].dispatchEvent(new PointerEvent('pointerleave'));
            return told;
        }"""
    assert ";" in (browser.execute_script(script, picture) or ""), "pointing at the first figure tells nothing"


def check_paper():
    printed = browser.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"]
    pages = base64.b64decode(printed).count(b"/Type /Page\n") or base64.b64decode(printed).count(b"/Type /Page ")
    if screenshots is not None:
        (screenshots / "print.pdf").write_bytes(base64.b64decode(printed))
    assert 0 < pages <= PAGES, f"{pages} pages on paper"
    return pages


def fill(name, value):
    script = "const f = document.getElementById(arguments[0]); f.value = arguments[1]; f.dispatchEvent(new Event('input', {bubbles: true}))"
    browser.execute_script(script, name, repr(value))


def evaluate(fit, form, block, asked):
    structure, _, suite = fit.rpartition(", ") if ", " in fit else (fit, "", "")
    call = [rockfrag, "evaluate", "--quiet", "--format", "json"] + (["--suite", suite] if suite else [])
    if form == "universal":
        call += ["--model", "universal"]
    else:
        call += ["--pex", f"{run}/pex.parquet", "--pro", f"{run}/pro.parquet", "--structure", structure]
        call += ["--model", "bivariate"] if form == "bivariate" else ["--model", "univariate", "--measure", form]
    names = ["width", "height"] if block else ["p", "alpha"]
    call += [word for name in names + ["eta", "pga", "pgv", "tp", "tm"] for word in (f"--{name}", repr(asked[name]))]
    rows = json.loads(subprocess.run(call, check=True, capture_output=True, text=True).stdout)["rows"]
    return {row["quantity"]: row for row in rows}


def check_calculator():
    draw = random.Random(1)
    fits = [option.text for option in Select(browser.find_element(By.ID, "fit")).options]
    worst = 0.0
    for question in range(QUESTIONS):
        fit = fits[question % len(fits)]
        Select(browser.find_element(By.ID, "fit")).select_by_visible_text(fit)
        forms = [option.get_attribute("value") for option in Select(browser.find_element(By.ID, "form")).options]
        form = [forms[0], forms[draw.randrange(len(forms))], "universal"][question % 3]
        Select(browser.find_element(By.ID, "form")).select_by_value(form)
        block = question % 5 == 4
        browser.execute_script("document.querySelector(`[name=by][value=${arguments[0]}]`).click()", "block" if block else "parameters")
        asked = {"p": draw.uniform(0.5, 4.0), "alpha": draw.uniform(0.08, 0.35), "width": draw.uniform(0.2, 2.0), "height": draw.uniform(2.5, 8.0)}
        asked |= {"eta": draw.uniform(0.85, 0.95), "pga": draw.uniform(0.05, 1.5), "pgv": draw.uniform(0.05, 2.0)}
        asked |= {"tp": draw.uniform(0.5, 6.0), "tm": draw.uniform(0.2, 1.5)}
        for name, value in asked.items():
            fill(name, value)
        expected = evaluate(fit, form, block, asked)
        for name in ANSWERS:
            row = browser.find_element(By.ID, f"answer-{name}")
            for here, there in [("value", "value"), ("low", "low"), ("high", "high")]:
                found, right = row.get_attribute(f"data-{here}"), expected[name][there]
                if right is None:
                    # A probability without doubt has no limits there and equal ones here.
                    assert there != "value" or found is None, f"{name}: {found}, expected none for {fit}, {form}, {asked}"
                    continue
                difference = abs(float(found) - right)
                assert difference < 1e-9, f"{name} {there}: {found}, expected {right} for {fit}, {form}, {asked}"
                worst = max(worst, difference)
    return worst


def check_keyboard():
    browser.execute_script("document.querySelector(`[name=by]`)?.click(); scrollTo(0, 0); document.activeElement.blur()")
    body = browser.find_element(By.TAG_NAME, "body")
    wanted = ["fit", "p", "alpha", "eta", "pga", "pgv", "space", "cloud", "motion", "next"]
    missing = {name for name in wanted if browser.find_elements(By.ID, name)}
    for _ in range(200):
        body = browser.switch_to.active_element
        body.send_keys(Keys.TAB)
        missing.discard(browser.switch_to.active_element.get_attribute("id"))
        if not missing:
            break
    assert not missing, f"the keyboard does not reach {missing}"
    picture = "return document.getElementById('space').toDataURL()"
    if browser.find_elements(By.ID, "space"):
        before = browser.execute_script(picture)
        browser.find_element(By.ID, "space").send_keys(Keys.ARROW_LEFT)
        assert browser.execute_script(picture) != before, "the arrow keys do not turn the planes"
    if browser.find_elements(By.ID, "next"):
        before = browser.find_element(By.ID, "motion-words").text
        browser.find_element(By.ID, "next").send_keys(Keys.ENTER)
        assert browser.find_element(By.ID, "motion-words").text != before, "the next motion is the same"


def check_width():
    wide = browser.execute_script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    assert wide <= 0, f"the page is {wide} pixels wider than its window"
    unsaid = "return [...document.querySelectorAll('.scroll')].filter((e) => e.scrollWidth > e.clientWidth + 1 && e.previousElementSibling.hidden).map((e) => e.ariaLabel)"
    unsaid = browser.execute_script(unsaid)
    assert not unsaid, f"cut without a word: {unsaid}"


def check_axe(scheme):
    found = chromium.violations(browser, axe)
    assert not found, f"{scheme}: axe-core: {found}"


browser = chromium.open_browser()
browser.set_script_timeout(120)
try:
    view(1280, 900, "light")
    browser.get(pathlib.Path(report).resolve().as_uri())
    browser.execute_async_script("document.fonts.ready.then(() => setTimeout(arguments[0], 300))")
    check_network()
    screenshot("light")
    pages = check_paper()
    open_folds()
    count = check_figures()
    check_hover()
    check_axe("light")
    answers = "no calculator"
    if browser.find_elements(By.ID, "calculator"):
        answers = f"{QUESTIONS} answers of the calculator within {check_calculator():.0e} of evaluate"
    check_keyboard()
    view(1280, 900, "dark")
    screenshot("dark")
    check_axe("dark")
    view(400, 800, "light")
    check_width()
    check_axe("narrow")
    screenshot("narrow")
    view(794, 1123, "light", "print")
    screenshot("print")
    view(1280, 900, "light")
    check_alone()
    errors = [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    assert not errors, f"the console says {errors}"
finally:
    browser.quit()
size = pathlib.Path(report).stat().st_size / 1e6
assert size < 5, f"the page is {size:.1f} MB"
print(f"report: {count} figures, {size:.1f} MB, {pages} pages on paper; {answers}; axe-core: nothing")
