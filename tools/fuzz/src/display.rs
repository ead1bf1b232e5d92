//! A display of the fuzzer's own.
//!
//! `DISPLAY` and `XAUTHORITY` have to be set before the process starts, because the intro reads them where the kernel keeps
//! them: `run` and the test set them. The display's number is above [`LEAST`], so no server of the machine is meant.

use crate::listener::Listener;
use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

/// Least number of a display that a fuzzer may take.
const LEAST: u32 = 1_000_000;

/// The display, which stays until the process ends.
pub struct Display {
    /// Its X server.
    pub server: Listener,
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
        fs::create_dir_all("/tmp/.X11-unix").unwrap();
        let server = Listener::open(format!("/tmp/.X11-unix/X{number}").into());
        Display { server, authority, number }
    }
}
