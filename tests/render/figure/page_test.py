#!/usr/bin/env python3
"""Opens the page of a small figure in a headless Chromium and uses it.

    page_test.py AUTOMORPH             makes a figure and tests its page
    page_test.py --pictures DIR PAGE   takes pictures of an existing page: light, dark, phone

Talks to Chromium by the DevTools protocol over its pipe, so nothing but Python and Chromium is needed. Without
Chromium the test is skipped: exit status 77.
"""
import base64
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77

# A label that tries to break out of the page, and one of no picture at all.
CONFIG = """title: "A <b>figure</b> & </script><script>window.broken=1</script>"
source: {shape: ellipsoid, semi_axes: [1, 0.8, 0.5], triangles: 300}
target: {shape: star, triangles: 400}
rows:
  - {label: "<img src=x onerror='window.broken=1'>", alignment: none, interpolation: linear}
  - {label: registered and turning, alignment: registration}
  - {label: by features, alignment: features, domain: cut}
alphas: [0, 1/4, 1/2, 3/4, 1]
picture: {width: 48, height: 48, spp: 2, color: displacement}
video: {frames: 8, size: 32, spp: 2, turntable: 6}
"""


class Browser:
    def __init__(self, program, folder):
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()

        def place_pipes():
            # DevTools listens on 3 and answers on 4. Copies first: either end may have one of these numbers.
            copies = os.dup(to_browser), os.dup(from_browser)
            os.dup2(copies[0], 3)
            os.dup2(copies[1], 4)

        flags = ["--headless", "--disable-gpu", "--remote-debugging-pipe", "--no-first-run", "--disable-extensions",
                 "--disable-dev-shm-usage", f"--user-data-dir={folder}/profile"]
        if os.geteuid() == 0:
            flags.append("--no-sandbox")
        self.process = subprocess.Popen([program, *flags, "about:blank"], close_fds=False, preexec_fn=place_pipes,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.next_id = 0
        self.events = []
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def message(self):
        while b"\0" not in self.buffer:
            data = os.read(self.read_end, 1 << 20)
            if not data:
                sys.exit("Chromium ended early")
            self.buffer += data
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        self.next_id += 1
        request = {"id": self.next_id, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.write_end, json.dumps(request).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") == self.next_id:
                if "error" in message:
                    sys.exit(f"{method}: {message['error']}")
                return message["result"]
            self.events.append(message)

    def open(self, url):
        self.events.clear()
        self.call("Page.navigate", url=url)
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self.events.append(self.message())

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            sys.exit(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def press(self, key, code, **more):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, **more)

    def resize(self, width, height, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)

    def scheme(self, name):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def picture(self, file, whole=True):
        data = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"]
        pathlib.Path(file).write_bytes(base64.b64decode(data))

    def close(self):
        self.process.terminate()
        self.process.wait()


failures = []


def check(name, holds, found=""):
    print(("ok      " if holds else "FAILED  ") + name + (f": found {found}" if not holds else ""))
    if not holds:
        failures.append(name)


def errors_of(browser):
    browser.value("1")  # what has happened so far has been told by then
    found = []
    for event in browser.events:
        if event["method"] == "Runtime.exceptionThrown":
            found.append(event["params"]["exceptionDetails"].get("exception", {}).get("description", "exception"))
        if event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
            found.append(event["params"]["entry"]["text"])
    return found


def shown(browser):
    return browser.value("[...document.querySelectorAll('.viewer img')].map(i => i.src)")


def check_overflow(browser, width):
    browser.resize(width, 800, phone=width < 600)
    check(f"no horizontal scrolling at {width} pixels",
          browser.value("document.documentElement.scrollWidth <= window.innerWidth"),
          browser.value("document.documentElement.scrollWidth"))


def check_made_of(browser):
    found = browser.value("[...document.querySelectorAll('#panels details')].map(d => [d.open, "
                          "d.querySelector('summary').textContent, [...d.querySelectorAll('figcaption')].map(c => c.textContent), "
                          "[...d.querySelectorAll('img')].every(i => i.naturalWidth >= 48 && i.src.startsWith('data:'))])")
    check("each morph tells what it is made of", len(found) == 3 and all(each[3] for each in found), found)
    check("only the first is open", [each[0] for each in found] == [True, False, False], found)
    sides = ["source, front of the sphere", "target, front of the sphere",
             "source, back of the sphere", "target, back of the sphere"]
    halves = ["source, half 1", "target, half 1", "source, half 2", "target, half 2"]
    check("maps on the sphere have two sides", found[0][2] == sides and found[1][2] == sides, found)
    check("a cut shape has two maps, and features are shown", found[2][2] == halves + ["source", "target"], found)
    check("the domain is told", "sphere" in found[0][1] and "by features – cut into two disks, features" == found[2][1], found)
    browser.value("document.querySelectorAll('#panels summary')[2].focus()")
    browser.press("Enter", 13, text="\r")
    check("a key opens it", browser.value("document.querySelectorAll('#panels details')[2].open"))
    check("that does not play", browser.value("document.getElementById('play').textContent") == "Play")
    browser.resize(375, 800, phone=True)
    tops = browser.value("[...document.querySelectorAll('#panels details')[2].querySelectorAll('img')].map(i => "
                         "Math.round(i.getBoundingClientRect().top))")
    check("source and target are side by side on a phone", tops[0] == tops[1] and tops[2] == tops[3] and tops[2] > tops[0], tops)
    browser.resize(1280, 900)


def check_page(browser, page, has_videos):
    browser.resize(1280, 900)
    browser.scheme("light")
    browser.open(page.as_uri())
    browser.value("Promise.all([...document.images].map(i => i.decode()))")
    check("loads without errors", errors_of(browser) == [], errors_of(browser))
    requests = [event["params"]["request"]["url"] for event in browser.events
                if event["method"] == "Network.requestWillBeSent"]
    foreign = [url for url in requests if not url.startswith(("file:", "data:"))]
    check("asks the network for nothing", foreign == [], foreign)
    check("texts stay texts", browser.value("window.broken === undefined && document.querySelector('h1 b') === null"))
    check("the title is told", "</script>" in browser.value("document.querySelector('h1').textContent"))
    check("all cells are pictures", browser.value(
        "[...document.querySelectorAll('#figure img')].filter(i => i.naturalWidth === 48).length") == 15)
    check("every picture has a text", browser.value("[...document.images].every(i => i.alt.length > 2)"))
    check("what the colours mean is told", browser.value(
        "(i => i.naturalWidth === 2 * i.clientWidth && /^colours from 0 to .*displacement/.test(i.alt))(document.querySelector('.legend'))"))
    check("all rows have a viewer and a plot", browser.value(
        "document.querySelectorAll('.viewer > img').length === 3 && document.querySelectorAll('.viewer svg').length === 3"))
    check_made_of(browser)
    check("the config is there word for word",
          browser.value("document.querySelector('#config pre').textContent") == CONFIG)

    first = shown(browser)
    browser.value("document.getElementById('scrub').focus()")
    browser.press("ArrowRight", 39)
    second = shown(browser)
    check("an arrow key on the slider changes all rows", all(a != b for a, b in zip(first, second)))
    check("the slider tells where it is",
          browser.value("document.getElementById('scrub').getAttribute('aria-valuetext')") == "α = 0.85")
    browser.value("document.activeElement.blur()")
    browser.press("ArrowLeft", 37)
    check("an arrow key on the page goes back", shown(browser) == first)
    browser.value("const s = document.getElementById('scrub'); s.value = 0; s.dispatchEvent(new Event('input'))")
    check("the slider's beginning is the source", browser.value("document.getElementById('position').value") == "α = 0.00")
    browser.value("document.activeElement.blur()")
    browser.press(" ", 32, text=" ")
    browser.value("new Promise(done => setTimeout(done, 400))")
    check("space plays", browser.value("document.getElementById('position').value") != "α = 0.00")
    browser.press(" ", 32, text=" ")
    check("space pauses", browser.value("document.getElementById('play').textContent") == "Play")
    browser.value("document.querySelector('#figure a:last-of-type').focus()")
    browser.press("Tab", 9)
    reached = [browser.value("document.activeElement.id || document.activeElement.tagName")]
    for _ in range(14):
        browser.press("Tab", 9)
        reached.append(browser.value("document.activeElement.id || document.activeElement.tagName"))
    check("the tab key reaches button and slider", "play" in reached and "scrub" in reached, reached)

    if has_videos:
        lengths = browser.value(
            "Promise.all([...document.querySelectorAll('video')].map(v => new Promise(done => { "
            "const tell = () => done([v.videoWidth, v.duration]); "
            "if (v.readyState > 0) tell(); else { v.onloadedmetadata = tell; v.onerror = () => done(null); "
            "setTimeout(() => done('late'), 10000); } })))")
        check("four videos play", len(lengths) == 4 and all(
            isinstance(each, list) and each[0] == 32 and each[1] > 0.3 for each in lengths), lengths)
    else:
        print("skipped videos: ffmpeg is not installed")

    for width in (320, 375, 768, 1280):
        check_overflow(browser, width)
    light = browser.value("getComputedStyle(document.body).backgroundColor")
    browser.scheme("dark")
    dark = browser.value("getComputedStyle(document.body).backgroundColor")
    check("dark is another scheme", light == "rgb(255, 255, 255)" and dark != light, (light, dark))
    check("no errors at the end", errors_of(browser) == [], errors_of(browser))


def check_page_alone(browser, page):
    """The page sent to somebody without its folder."""
    alone = page.parent.parent / "alone" / page.name
    alone.parent.mkdir()
    shutil.copy(page, alone)
    browser.open(alone.as_uri())
    browser.value("new Promise(done => setTimeout(done, 1500))")
    check("it has its videos inside", browser.value(
        "[...document.querySelectorAll('video')].every(v => v.clientHeight > 0 && v.readyState > 0 && v.duration > 0.3)"))
    text = alone.read_text()
    assert '"films":["data:' in text
    alone.write_text(re.sub(r'"films":\["data:[^]]*\]', '"films":[]', text))  # as with large ones
    browser.open(alone.as_uri())
    browser.value("new Promise(done => setTimeout(done, 500))")
    check("videos that are not there are not shown, and it is said", browser.value(
        "[...document.querySelectorAll('video')].every(v => v.clientHeight === 0 && "
        "v.parentElement.textContent.includes('lie beside the page'))"))


def take_pictures(browser, folder, page):
    folder.mkdir(parents=True, exist_ok=True)
    browser.resize(1280, 900)
    browser.scheme("light")
    browser.open(page.as_uri())
    browser.value("Promise.all([...document.images].map(i => i.decode()))")
    browser.value("new Promise(done => setTimeout(done, 1500))")
    for name, scheme, width in (("light", "light", 1280), ("dark", "dark", 1280), ("phone", "light", 375)):
        browser.scheme(scheme)
        browser.resize(width, 900, phone=width < 600)
        browser.value("new Promise(done => setTimeout(done, 300))")
        browser.picture(folder / f"{name}.png")


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        print("skipped: the page needs Chromium to be tested (Debian package chromium)")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        folder = pathlib.Path(temporary)
        if sys.argv[1] != "--pictures":
            (folder / "small.yaml").write_text(CONFIG)
            subprocess.run([sys.argv[1], "-q", "figure", "small.yaml", "--out", "out"], cwd=folder, check=True)
        browser = Browser(chromium, folder)
        try:
            if sys.argv[1] == "--pictures":
                take_pictures(browser, pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]).resolve())
            else:
                has_videos = shutil.which("ffmpeg") is not None
                check_page(browser, folder / "out/index.html", has_videos)
                if has_videos:
                    check_page_alone(browser, folder / "out/index.html")
        finally:
            browser.close()
    sys.exit(1 if failures else 0)


main()
