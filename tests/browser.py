# browser.py CHROMIUM PROFILE - a browser without a window, for tests of pages: reads lines, answers each with one.
#
#     open ADDRESS        goes there
#     width PIXELS        of the window
#     hurry FACTOR        what pages wait for comes so many times sooner; before `open`
#     until EXPRESSION    of the page's script: answers when it is true
#     value EXPRESSION    answers with it, as JSON
#     faults              what went wrong in the page so far: errors of scripts, what its policy forbade
#     end                 closes the browser: answers when the last of its processes is gone
#
# Speaks the DevTools protocol over two pipes (--remote-debugging-pipe), so it needs nothing but Python.
import json, os, subprocess, sys, time

to_browser, from_browser = os.pipe(), os.pipe()


def pipes():
    os.dup2(to_browser[0], 3)
    os.dup2(from_browser[1], 4)


os.set_inheritable(to_browser[0], True)
os.set_inheritable(from_browser[1], True)
browser = subprocess.Popen(
    [sys.argv[1], "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
     "--disable-background-networking", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
     "--user-data-dir=" + sys.argv[2], "--remote-debugging-pipe", "about:blank"],
    preexec_fn=pipes, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
os.close(to_browser[0])
os.close(from_browser[1])
number, rest, faults = 0, b"", []


def call(method, session=None, **parameters):
    global number, rest
    number += 1
    message = {"id": number, "method": method, "params": parameters}
    if session: message["sessionId"] = session
    os.write(to_browser[1], json.dumps(message).encode() + b"\0")
    while True:
        while b"\0" not in rest:
            part = os.read(from_browser[0], 1 << 16)
            if not part: sys.exit("the browser is gone")
            rest += part
        text, rest = rest.split(b"\0", 1)
        answer = json.loads(text)
        if answer.get("method") == "Runtime.exceptionThrown":
            faults.append(answer["params"]["exceptionDetails"].get("text", "") + " " +
                          answer["params"]["exceptionDetails"].get("exception", {}).get("description", ""))
        if answer.get("method") == "Log.entryAdded" and answer["params"]["entry"]["source"] in ("security", "javascript"):
            faults.append(answer["params"]["entry"]["text"])
        if answer.get("id") == number: return answer.get("result", answer)


def value(expression):
    return call("Runtime.evaluate", page, expression=expression, returnByValue=True)["result"].get("value")


def helpers():  # those of its processes that leave its session outlive it a little
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.readlink("/proc/%s/cwd" % name) == os.getcwd() and "chrom" in os.readlink("/proc/%s/exe" % name):
                return True
        except OSError: pass  # gone, or not ours
    return False


def end():
    call("Browser.close")
    browser.wait()
    while helpers(): time.sleep(0.01)


target = next(t for t in call("Target.getTargets")["targetInfos"] if t["type"] == "page")
page = call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
for domain in ("Page", "Runtime", "Log"): call(domain + ".enable", page)
for line in sys.stdin:
    word, _, what = line.rstrip("\n").partition(" ")
    answer = "done"
    if word == "open": call("Page.navigate", page, url=what)
    if word == "width":
        call("Emulation.setDeviceMetricsOverride", page, width=int(what), height=800, deviceScaleFactor=1, mobile=True)
    if word == "hurry":
        call("Page.addScriptToEvaluateOnNewDocument", page,
             source="{ const wait = window.setTimeout; window.setTimeout = (f, ms) => wait(f, ms / %d); }" % int(what))
    if word == "until":
        while value(what) is not True: time.sleep(0.05)
    if word == "value": answer = json.dumps(value(what))
    if word == "faults": answer = json.dumps(faults)
    if word == "end": end()
    print(answer, flush=True)
    if word == "end": break
