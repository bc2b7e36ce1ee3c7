"""Opens a report in headless Chromium and looks at it as a reader would: python3 tests/browser/look.py REPORT.html [SCREENSHOTS]

Needs Debian's chromium and chromium-driver and Python's standard library. Fails where the console complains, a plot is missing
or blank, a link leads nowhere, a column does not sort, rows do not filter, or print and a phone cut something off.
"""

import base64
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.request

PORT = 9517
# A picture of a plot with axes and curves takes more; a blank one of any size takes less.
BLANK = 2500
A4 = 718  # Pixels between the margins of a printed page.


class Browser:
    def __init__(self):
        self.driver = subprocess.Popen(["chromedriver", f"--port={PORT}"], stdout=subprocess.DEVNULL)
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        arguments = [
            "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            f"--user-data-dir={self.profile.name}",
        ]
        wanted = {"goog:chromeOptions": {"args": arguments}, "goog:loggingPrefs": {"browser": "ALL"}}
        for attempt in range(50):
            try:
                made = self.call("", {"capabilities": {"alwaysMatch": wanted}}, session=False)
                break
            except OSError:
                if attempt == 49:
                    raise
                time.sleep(0.2)
        self.session = made["sessionId"]

    def call(self, path, body=None, session=True, method=None):
        place = f"http://127.0.0.1:{PORT}/session" + (f"/{self.session}" if session else "") + path
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(place, data, {"Content-Type": "application/json"}, method=method)
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def run(self, script, *arguments):
        return self.call("/execute/sync", {"script": script, "args": list(arguments)})

    def devtools(self, command, **parameters):
        return self.call("/goog/cdp/execute", {"cmd": command, "params": parameters})

    def size(self, width, height):
        self.devtools(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False
        )

    def picture(self):
        return base64.b64decode(self.call("/screenshot"))

    def close(self):
        try:
            self.call("", method="DELETE")
        finally:
            self.driver.terminate()
            self.driver.wait()


def look(browser, page, shots):
    wrong = []
    browser.size(1280, 900)
    browser.call("/url", {"url": page.resolve().as_uri()})

    links = browser.run("return [...document.querySelectorAll('a')].map(a => a.getAttribute('href'))")
    lost = [link for link in links if not browser.run("return !!document.getElementById(arguments[0].slice(1))", link)]
    if not links or lost:
        wrong.append(f"{len(links)} links, of which these lead nowhere: {lost[:5]}")

    figures = browser.call("/elements", {"using": "css selector", "value": "figure svg"})
    for element in figures:
        drawn = base64.b64decode(browser.call(f"/element/{next(iter(element.values()))}/screenshot"))
        if len(drawn) < BLANK:
            wrong.append(f"a plot is blank: {browser.run('return arguments[0].textContent', element)[:80]}")
    if not figures:
        wrong.append("no plot is on the page")

    unsorted = browser.run(
        """const bad = [];
        for (const table of document.querySelectorAll('table.sortable')) {
          [...table.tHead.rows[0].cells].forEach((head, column) => {
            const before = table.tBodies[0].rows.length;
            for (const way of ['ascending', 'descending']) {
              head.querySelector('button').click();
              const texts = [...table.tBodies[0].rows].map(row => row.cells[column].textContent.trim());
              const numbers = texts.map(text => text === '' ? NaN : Number(text));
              const sign = way === 'ascending' ? 1 : -1;
              if (numbers.every(Number.isFinite) && numbers.some((n, i) => i > 0 && sign * (n - numbers[i - 1]) < 0))
                bad.push(head.textContent);
              if (head.getAttribute('aria-sort') !== way || texts.length !== before) bad.push(head.textContent);
            }
          });
        }
        return [document.querySelectorAll('table.sortable').length, bad]"""
    )
    if unsorted[0] == 0 or unsorted[1]:
        wrong.append(f"{unsorted[0]} tables, whose columns {unsorted[1][:5]} do not sort")

    left, shown, claims = browser.run(
        """const field = document.querySelector('.filter input'), rows = () => document.querySelectorAll('table.filtered tbody tr');
        field.value = 'no claim is called so'; field.dispatchEvent(new Event('input'));
        const left = [...rows()].filter(row => row.offsetParent).length;
        field.value = ''; field.dispatchEvent(new Event('input'));
        return [left, [...rows()].filter(row => row.offsetParent).length, rows().length]"""
    )
    if left != 0 or shown != claims or claims == 0:
        wrong.append(f"the filter leaves {left} of {claims} rows for nothing and shows {shown} for all")

    headings = browser.run("return [...document.querySelectorAll('h1,h2,h3')].map(h => Number(h.tagName[1]))")
    if headings[0] != 1 or headings.count(1) != 1 or any(b > a + 1 for a, b in zip(headings, headings[1:])):
        wrong.append("headings skip a level")
    unnamed = browser.run("return [...document.querySelectorAll('figure svg')].filter(s => !s.querySelector('title')).length")
    if unnamed:
        wrong.append(f"{unnamed} plots have no title to be read aloud")

    for name, width in [("desktop", 1280), ("phone", 390)]:
        browser.size(width, 900)
        over = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
        if over > 0:
            wrong.append(f"at {width} pixels the page is {over} pixels too wide")
        if shots:
            (shots / f"{name}.png").write_bytes(browser.picture())

    browser.devtools("Emulation.setEmulatedMedia", media="print")
    browser.size(A4, 1000)
    cut = browser.run(
        """return [...document.querySelectorAll('table, figure svg')].filter(part => part.getBoundingClientRect().right > window.innerWidth + 1)
        .map(part => part.textContent.trim().slice(0, 60))"""
    )
    if cut:
        wrong.append(f"{len(cut)} tables or plots are cut off in print: {cut[:3]}")
    pdf = base64.b64decode(browser.call("/print", {}))
    if not pdf.startswith(b"%PDF") or len(pdf) < 100_000:
        wrong.append("printing leaves no document")
    if shots:
        (shots / "print.pdf").write_bytes(pdf)
    browser.devtools("Emulation.setEmulatedMedia", media="")

    browser.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    browser.size(1280, 900)
    ground, ink = browser.run(
        "const s = getComputedStyle(document.body); return [s.backgroundColor, s.color].map(c => c.match(/\\d+/g).map(Number))"
    )
    if sum(ground) > 150 or sum(ink) < 500:
        wrong.append(f"dark is not dark: {ink} on {ground}")
    if shots:
        (shots / "dark.png").write_bytes(browser.picture())

    said = [entry["message"] for entry in browser.call("/se/log", {"type": "browser"})]
    if said:
        wrong.append(f"the console says: {said[:3]}")
    print(f"{page}: {len(figures)} plots, {len(links)} links, {unsorted[0]} tables, {claims} claims, {len(pdf)} bytes in print")
    return wrong


def main():
    page = pathlib.Path(sys.argv[1])
    shots = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if shots:
        shots.mkdir(parents=True, exist_ok=True)
    browser = Browser()
    try:
        wrong = look(browser, page, shots)
    finally:
        browser.close()
    for one in wrong:
        print(f"error: {one}", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
