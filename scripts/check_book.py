"""Looks at each page of a folder (the book, a report) in a headless Chromium: python check_book.py FOLDER AXE

No finding of axe-core, light in a window of 1280 pixels and dark in one of 400, where no page is wider than the window.
"""

import concurrent.futures
import pathlib
import sys

from browser import open_browser, view, violations

VIEWS = [(1280, "light"), (400, "dark")]
BROWSERS = 2
book, axe = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]


def faults(pages):
    browser = open_browser()
    try:
        for page in pages:
            browser.get(page.as_uri())
            for width, scheme in VIEWS:
                view(browser, width, 900, scheme)
                place = f"{page.relative_to(book)}, {width} px, {scheme}"
                for finding in violations(browser, axe):
                    yield f"{place}: axe-core: {finding}"
                if browser.execute_script("return document.documentElement.scrollWidth") > width:
                    yield f"{place}: wider than the window"
    finally:
        browser.quit()


pages = sorted(book.rglob("*.html"))
shares = [pages[first::BROWSERS] for first in range(BROWSERS)]
with concurrent.futures.ThreadPoolExecutor() as pool:
    found = [fault for share in pool.map(lambda share: list(faults(share)), shares) for fault in share]
if found:
    sys.exit("\n".join(found))
print(f"{book.name}: {len(pages)} pages; axe-core: nothing")
