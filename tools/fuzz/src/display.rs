//! A display of the fuzzer's own, which says what an input wants.
//!
//! `DISPLAY` and `XAUTHORITY` have to be set before the process starts, because the intro reads them where the kernel keeps
//! them: `run` and the test set them. The display's number is above [`LEAST`], so no server of the machine is meant.

use std::env;
use std::fs;
use std::io::{Read, Write};
use std::net::Shutdown;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, OnceLock};
use std::thread;

/// Least number of a display that a fuzzer may take.
const LEAST: u32 = 1_000_000;
/// Most bytes that a client is heard. A true server would go on.
const MOST_HEARD: usize = 1 << 20;

/// What the server does with a client.
#[derive(Default)]
struct Talk {
    /// What it says to each, before it says no more.
    says: Vec<u8>,
    /// What each client has said.
    heard: Vec<Vec<u8>>,
}

/// The display, which stays until the process ends.
pub struct Display {
    talk: Arc<Mutex<Talk>>,
    /// The authority file.
    pub authority: PathBuf,
    /// The number, as text.
    pub number: String,
}

impl Display {
    /// The display of this process.
    pub fn get() -> &'static Display {
        static DISPLAY: OnceLock<Display> = OnceLock::new();
        DISPLAY.get_or_init(Display::open)
    }

    fn open() -> Display {
        let name = env::var("DISPLAY").unwrap_or_default();
        let number = name.strip_prefix(':').unwrap_or_default().to_owned();
        assert!(number.parse().is_ok_and(|number: u32| number >= LEAST), "set DISPLAY to a number above {LEAST}");
        let authority =
            PathBuf::from(env::var_os("XAUTHORITY").expect("XAUTHORITY is to be a file of the fuzzer's own"));
        // A client that has heard enough hangs up in the middle of a word.
        let ignored = Arc::new(AtomicBool::new(false));
        signal_hook::flag::register(13, ignored).expect("SIGPIPE can be ignored");
        fs::create_dir_all("/tmp/.X11-unix").unwrap();
        let socket = format!("/tmp/.X11-unix/X{number}");
        let _ = fs::remove_file(&socket);
        let listener = UnixListener::bind(socket).expect("a socket");
        let talk = Arc::new(Mutex::new(Talk::default()));
        let told = talk.clone();
        thread::spawn(move || {
            for client in listener.incoming() {
                // A client that has gone is no error of ours.
                let _ = client.and_then(|client| serve(client, &told));
            }
        });
        Display { talk, authority, number }
    }

    /// Has the server say this to each client from now on.
    pub fn says(&self, bytes: &[u8]) {
        *self.talk.lock().unwrap() = Talk { says: bytes.to_vec(), heard: Vec::new() };
    }

    /// What clients have said since, one after the other. The last one has to have hung up.
    pub fn heard(&self) -> Vec<Vec<u8>> {
        // Clients are served one by one, so when this one has been served all before it have.
        drop(UnixStream::connect(format!("/tmp/.X11-unix/X{}", self.number)).map(|mut client| {
            let _ = client.shutdown(Shutdown::Write);
            let _ = client.read_to_end(&mut Vec::new());
        }));
        self.talk.lock().unwrap().heard.clone()
    }
}

/// Says what there is to say, and hears the client out.
fn serve(mut client: UnixStream, talk: &Mutex<Talk>) -> std::io::Result<()> {
    let says = talk.lock().unwrap().says.clone();
    client.write_all(&says)?;
    client.shutdown(Shutdown::Write)?;
    let mut heard = Vec::new();
    let _ = (&mut client).take(MOST_HEARD as u64).read_to_end(&mut heard);
    talk.lock().unwrap().heard.push(heard);
    Ok(())
}
