//! A server of files for this machine alone. It sends the files of one directory as they are, without any header that a
//! plain static host would not send too.

use std::error::Error;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// The longest request that is read, bytes.
const LONGEST: u64 = 16_384;
/// How long a browser may be silent.
const PATIENCE: Duration = Duration::from_secs(10);

/// Names end in one of these; whatever else there is, is bytes.
const TYPES: [(&str, &str); 5] = [
    ("html", "text/html; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("wasm", "application/wasm"),
    ("svg", "image/svg+xml"),
];

/// A server that listens.
pub struct Server {
    listener: TcpListener,
    directory: PathBuf,
}

impl Server {
    /// Listens at a port of this machine that other machines do not reach; any free one for 0.
    pub fn new(directory: &Path, port: u16) -> Result<Server, Box<dyn Error>> {
        if !directory.join("index.html").is_file() {
            return Err(format!("{} has no index.html; page build makes it", directory.display()).into());
        }
        let listener =
            TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|error| format!("port {port}: {error}"))?;
        Ok(Server { listener, directory: directory.to_owned() })
    }

    /// Where it listens.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }

    /// Answers requests for as long as the program runs, each connection on a thread of its own.
    pub fn run(self) {
        for stream in self.listener.incoming().flatten() {
            let directory = self.directory.clone();
            // A browser that goes in the middle is no concern of the others.
            thread::spawn(move || _ = answer(stream, &directory));
        }
    }
}

/// Answers the one request of a connection.
fn answer(mut stream: TcpStream, directory: &Path) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    let mut reader = BufReader::new(stream.try_clone()?.take(LONGEST));
    let mut line = String::new();
    reader.read_line(&mut line)?;
    // The headers, up to the empty line: none of them matters.
    let mut header = String::new();
    while reader.read_line(&mut header)? > 2 {
        header.clear();
    }
    let (status, kind, body) = match requested(&line) {
        None => ("400 Bad Request", TYPES[0].1, b"only GET".to_vec()),
        Some(name) => match fs::read(directory.join(name)) {
            Ok(body) => ("200 OK", kind(name), body),
            Err(_) => ("404 Not Found", TYPES[0].1, b"no such file".to_vec()),
        },
    };
    let length = body.len();
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nCache-Control: no-cache\r\nConnection: close\r\n\r\n"
    )?;
    stream.write_all(&body)
}

/// The file that the first line of a request asks for: the page itself for `/`. None for what is no GET, and for whatever
/// might lead out of the directory, which has no directories in it.
fn requested(line: &str) -> Option<&str> {
    let path = line.strip_prefix("GET /")?.split([' ', '?', '#']).next()?;
    let plain =
        path.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"._-".contains(&byte)) && !path.starts_with('.');
    plain.then_some(if path.is_empty() { "index.html" } else { path })
}

/// The type of a file.
fn kind(name: &str) -> &'static str {
    let ending = name.rsplit('.').next().unwrap_or_default();
    TYPES.iter().find(|known| known.0 == ending).map_or("application/octet-stream", |known| known.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_leads_out_of_the_directory() {
        assert_eq!(requested("GET / HTTP/1.1\r\n"), Some("index.html"));
        assert_eq!(requested("GET /main.js?v=1 HTTP/1.1\r\n"), Some("main.js"));
        for line in [
            "GET /../secret HTTP/1.1",
            "GET /.git HTTP/1.1",
            "GET //etc/passwd HTTP/1.1",
            "POST / HTTP/1.1",
            "GET /a%2e",
        ] {
            assert_eq!(requested(line), None, "{line}");
        }
    }

    #[test]
    fn modules_have_the_type_that_streams() {
        assert_eq!(kind("paprsek.wasm"), "application/wasm");
        assert_eq!(kind("nothing"), "application/octet-stream");
    }
}
