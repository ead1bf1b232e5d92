//! An X server without a screen, which keeps its pixels in a file.

use crate::options::Result;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// Pixels in a row, and rows.
pub const SIZE: (usize, usize) = (1280, 720);
const ROW: usize = 4 * SIZE.0;

/// A running server; it ends with this value.
pub struct Xvfb {
    server: Child,
    /// The `DISPLAY` of programs that are to be shown here.
    pub display: String,
    folder: TempDir,
}

impl Xvfb {
    /// Starts a server of [`SIZE`] on a free display.
    pub fn start() -> Result<Xvfb> {
        let folder = tempfile::tempdir()?;
        let (width, height) = SIZE;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &format!("{width}x{height}x24"), "-nolisten", "tcp", "-noreset"])
            .arg("-fbdir")
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("Xvfb: {error}"))?;
        let mut number = String::new();
        BufReader::new(server.stdout.take().ok_or("no pipe")?).read_line(&mut number)?;
        Ok(Xvfb { server, display: format!(":{}", number.trim()), folder })
    }

    /// The pixels of the screen, four bytes each, blue first. The file has a header, so rows count from its end.
    pub fn pixels(&self) -> Result<Vec<u8>> {
        self.read(ROW * SIZE.1, ROW * SIZE.1)
    }

    /// Whether a picture is shown: the row in the middle has more than a few values, which an empty window has not.
    pub fn shows_a_picture(&self) -> Result<bool> {
        let mut seen = [false; 256];
        self.read(ROW * SIZE.1 / 2, ROW)?.into_iter().for_each(|byte| seen[usize::from(byte)] = true);
        Ok(seen.into_iter().filter(|seen| *seen).count() > 8)
    }

    /// Bytes of the screen's file from so far before its end.
    fn read(&self, before_end: usize, count: usize) -> Result<Vec<u8>> {
        let mut file = File::open(self.folder.path().join("Xvfb_screen0"))?;
        file.seek(SeekFrom::End(-i64::try_from(before_end)?))?;
        let mut bytes = vec![0; count];
        file.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

impl Drop for Xvfb {
    fn drop(&mut self) {
        // Whether it had ended before does not matter.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
