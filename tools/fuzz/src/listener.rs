//! A server of the fuzzer's own at a Unix socket, which says what an input wants and hears what the intro says.

use std::fs;
use std::io::{Read, Write};
use std::net::Shutdown;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use std::thread;

/// Most bytes that a client is heard. A true server would go on.
const MOST_HEARD: usize = 1 << 21;

/// What the server does with a client.
#[derive(Default)]
struct Talk {
    /// What it says to each, before it says no more.
    says: Vec<u8>,
    /// What each client has said.
    heard: Vec<Vec<u8>>,
}

/// The server, which stays until the process ends.
pub struct Listener {
    path: PathBuf,
    talk: Arc<Mutex<Talk>>,
}

impl Listener {
    /// A server at a path, which nobody else may need.
    pub fn open(path: PathBuf) -> Listener {
        // A client that has heard enough hangs up in the middle of a word.
        let ignored = Arc::new(AtomicBool::new(false));
        signal_hook::flag::register(13, ignored).expect("SIGPIPE can be ignored");
        let _ = fs::remove_file(&path);
        let listener = UnixListener::bind(&path).expect("a socket");
        let talk = Arc::new(Mutex::new(Talk::default()));
        let told = talk.clone();
        thread::spawn(move || {
            for client in listener.incoming().flatten() {
                serve(client, &told);
            }
        });
        Listener { path, talk }
    }

    /// Has the server say this to each client from now on.
    pub fn says(&self, bytes: &[u8]) {
        *self.talk.lock().unwrap() = Talk { says: bytes.to_vec(), heard: Vec::new() };
    }

    /// What clients have said since, one after the other. The last one has to have hung up.
    pub fn heard(&self) -> Vec<Vec<u8>> {
        // Clients are served one by one, so when this one has been served all before it have.
        drop(UnixStream::connect(&self.path).map(|mut client| {
            let _ = client.shutdown(Shutdown::Write);
            let _ = client.read_to_end(&mut Vec::new());
        }));
        self.talk.lock().unwrap().heard.clone()
    }
}

/// Says what there is to say, and hears the client out. One that has gone in the meantime is no error of ours.
fn serve(mut client: UnixStream, talk: &Mutex<Talk>) {
    let says = talk.lock().unwrap().says.clone();
    let _ = client.write_all(&says);
    let _ = client.shutdown(Shutdown::Write);
    let mut heard = Vec::new();
    let _ = (&mut client).take(MOST_HEARD as u64).read_to_end(&mut heard);
    // One that says nothing only waits for its turn.
    if !heard.is_empty() {
        talk.lock().unwrap().heard.push(heard);
    }
}
