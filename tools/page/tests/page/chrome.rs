//! A browser without a screen, driven by its DevTools protocol.
#![allow(dead_code, reason = "the tests and the examples each use some of it")]

use base64::prelude::{BASE64_STANDARD, Engine};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket};

/// The longest that anything in the browser may take.
const PATIENCE: Duration = Duration::from_secs(120);
/// From one look at the page to the next.
const POLL: Duration = Duration::from_millis(50);

/// A running browser with one page open.
pub struct Chrome {
    child: Child,
    socket: WebSocket<TcpStream>,
    /// The page's session of the protocol.
    session: String,
    /// The page's target.
    pub target: String,
    calls: u64,
    /// What the console had that should not be there, workers' consoles included.
    pub errors: Vec<String>,
    /// Where it keeps what it knows, and what it downloads.
    pub directory: TempDir,
}

impl Chrome {
    /// Starts the browser with an empty page of that many CSS pixels.
    pub fn start(width: u32, height: u32) -> Chrome {
        let directory = tempfile::tempdir().unwrap();
        let mut command = Command::new("chromium");
        // The sandbox takes rights that the gate's container lacks; the pages are our own.
        command.args([
            "--headless=new",
            "--no-sandbox",
            "--remote-debugging-port=0",
            "--disable-gpu",
            "--no-first-run",
        ]);
        command.arg(format!("--user-data-dir={}", directory.path().join("profile").display()));
        command.arg(format!("--window-size={width},{height}")).arg("about:blank");
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut said = BufReader::new(child.stderr.take().unwrap());
        let address = loop {
            let mut line = String::new();
            assert!(said.read_line(&mut line).unwrap() > 0, "the browser does not start");
            if let Some(address) = line.trim().strip_prefix("DevTools listening on ") {
                break address.to_owned();
            }
        };
        // Whatever else it says is read, so that it is never kept waiting.
        thread::spawn(move || said.read_to_end(&mut Vec::new()));
        let host = address.strip_prefix("ws://").and_then(|rest| rest.split('/').next()).unwrap();
        let stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) = tungstenite::client(&*address, stream).unwrap();
        let (session, target) = (String::new(), String::new());
        let mut chrome = Chrome { child, socket, session, target, calls: 0, errors: Vec::new(), directory };
        let targets = chrome.call("Target.getTargets", json!({}));
        let targets = targets["targetInfos"].as_array().unwrap();
        let page = targets.iter().find(|target| target["type"] == "page").expect("a page");
        chrome.target = page["targetId"].as_str().unwrap().to_owned();
        let attached = chrome.call("Target.attachToTarget", json!({ "targetId": chrome.target, "flatten": true }));
        chrome.session = attached["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Runtime", "Log", "Page"] {
            chrome.call(&format!("{domain}.enable"), json!({}));
        }
        // Consoles of workers too.
        let workers = json!({ "autoAttach": true, "waitForDebuggerOnStart": false, "flatten": true });
        chrome.call("Target.setAutoAttach", workers);
        chrome.size(width, height);
        let downloads = chrome.directory.path().join("downloads");
        std::fs::create_dir(&downloads).unwrap();
        chrome.browser("Browser.setDownloadBehavior", json!({ "behavior": "allow", "downloadPath": downloads }));
        chrome
    }

    /// Gives the page that many CSS pixels.
    pub fn size(&mut self, width: u32, height: u32) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
    }

    /// Opens an address, and forgets the errors of the page before.
    pub fn open(&mut self, address: &str) {
        self.errors.clear();
        self.call("Page.navigate", json!({ "url": address }));
    }

    /// A method of the page's session; before there is one, of the browser's.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        let session = self.session.clone();
        self.send(&session, method, parameters)
    }

    /// A method of the browser's own session.
    pub fn browser(&mut self, method: &str, parameters: Value) -> Value {
        self.send("", method, parameters)
    }

    fn send(&mut self, session: &str, method: &str, parameters: Value) -> Value {
        let number = self.write(session, method, parameters);
        loop {
            let text = self.socket.read().unwrap_or_else(|error| panic!("{method}: {error}"));
            let Message::Text(text) = text else { continue };
            let message: Value = serde_json::from_str(&text).unwrap();
            if message["id"] == number {
                assert!(message["error"].is_null(), "{method}: {}", message["error"]);
                return message["result"].clone();
            }
            self.hear(&message);
        }
    }

    fn write(&mut self, session: &str, method: &str, parameters: Value) -> u64 {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": parameters });
        if !session.is_empty() {
            message["sessionId"] = session.into();
        }
        self.socket.send(Message::text(message.to_string())).unwrap();
        self.calls
    }

    /// An event.
    fn hear(&mut self, message: &Value) {
        let of = &message["params"];
        match message["method"].as_str().unwrap_or_default() {
            "Target.attachedToTarget" => {
                let session = of["sessionId"].as_str().unwrap().to_owned();
                self.write(&session, "Runtime.enable", json!({}));
            }
            "Runtime.exceptionThrown" => self.errors.push(of["exceptionDetails"].to_string()),
            "Runtime.consoleAPICalled" if of["type"] == "error" || of["type"] == "warning" => {
                self.errors.push(of["args"].to_string());
            }
            "Log.entryAdded" if of["entry"]["level"] == "error" || of["entry"]["level"] == "warning" => {
                self.errors.push(of["entry"].to_string());
            }
            _ => {}
        }
    }

    /// The value of an expression of JavaScript in the page, awaited.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let asked = json!({
            "expression": expression, "awaitPromise": true, "returnByValue": true, "userGesture": true,
        });
        let result = self.call("Runtime.evaluate", asked);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn until(&mut self, expression: &str) {
        let began = Instant::now();
        while self.evaluate(expression) != true {
            assert!(began.elapsed() < PATIENCE, "never: {expression}; the console had {:?}", self.errors);
            thread::sleep(POLL);
        }
    }

    /// Presses and releases a key: its name, and the text that it types, if any.
    pub fn press(&mut self, key: &str, text: &str) {
        let code = match key {
            "ArrowLeft" => 37,
            "ArrowRight" => 39,
            "Tab" => 9,
            "Escape" => 27,
            "Enter" => 13,
            _ => key.to_uppercase().as_bytes()[0],
        };
        for kind in [if text.is_empty() { "rawKeyDown" } else { "keyDown" }, "keyUp"] {
            let event = json!({ "type": kind, "key": key, "text": text, "windowsVirtualKeyCode": code });
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// An event of the mouse with its left button, at a place in CSS pixels: `mousePressed`, `mouseMoved`, `mouseReleased`.
    pub fn mouse(&mut self, kind: &str, (x, y): (f64, f64)) {
        let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1 });
        self.call("Input.dispatchMouseEvent", event);
    }

    /// An event of one finger, at a place in CSS pixels: `touchStart`, `touchMove`, or `touchEnd`, which has no place.
    pub fn touch(&mut self, kind: &str, place: Option<(f64, f64)>) {
        let points: Vec<_> = place.iter().map(|(x, y)| json!({ "x": x, "y": y })).collect();
        self.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }));
    }

    /// Has every page that is opened from now on run a script before its own.
    pub fn before(&mut self, script: &str) {
        self.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": script }));
    }

    /// Processor time that all of the browser's processes have taken so far, seconds: what other programs leave it does not
    /// count.
    pub fn work(&self) -> f64 {
        let mut processes = Vec::new();
        for entry in std::fs::read_dir("/proc").unwrap().flatten() {
            // Whatever ends meanwhile is left out.
            let Ok(text) = std::fs::read_to_string(entry.path().join("stat")) else { continue };
            // The name, in brackets, may have any character.
            let (Some(number), Some((_, rest))) =
                (entry.file_name().to_str().and_then(|name| name.parse().ok()), text.rsplit_once(") "))
            else {
                continue;
            };
            let fields: Vec<&str> = rest.split(' ').collect();
            let field = |place: usize| fields[place].parse::<u64>().unwrap();
            processes.push((number, field(1), field(11) + field(12)));
        }
        let mut known: Vec<u64> = vec![self.child.id().into()];
        let mut at = 0;
        while at < known.len() {
            let parent = known[at];
            known.extend(processes.iter().filter(|process| process.1 == parent).map(|process| process.0));
            at += 1;
        }
        // Linux tells programs of hundredths of a second on every machine.
        processes.iter().filter(|process| known.contains(&process.0)).map(|process| process.2).sum::<u64>() as f64
            / 100.0
    }

    /// A picture of the page, as a PNG file.
    pub fn screenshot(&mut self) -> Vec<u8> {
        let picture = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        BASE64_STANDARD.decode(picture["data"].as_str().unwrap()).unwrap()
    }
}

impl Drop for Chrome {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}
