//! `page build` compiles `web/` to WebAssembly with SIMD and puts the module beside the files of `web/page`, in
//! `target/web`. `page serve` serves that directory to this machine alone, until it is ended.

use page::{build, serve};
use std::env;
use std::error::Error;
use std::path::PathBuf;

const USAGE: &str = "usage: page build [--out DIR], page serve [--port N] [--dir DIR]";
/// Where the server listens if it is not told.
const PORT: u16 = 8080;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = env::args().skip(1).collect();
    let (command, options) = words.split_first().ok_or(USAGE)?;
    let (known, rest) = options.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(USAGE.into());
    }
    let target = build::target();
    let mut directory = target.join("web");
    let mut port = PORT;
    for [name, value] in known {
        match (&**command, &**name) {
            ("build", "--out") | ("serve", "--dir") => directory = PathBuf::from(value),
            ("serve", "--port") => port = value.parse().map_err(|_| USAGE)?,
            _ => return Err(USAGE.into()),
        }
    }
    match &**command {
        "build" => {
            let bytes = build::build(&target, &directory)?;
            println!("{}: {bytes} bytes", directory.display());
        }
        "serve" => {
            let server = serve::Server::new(&directory, port)?;
            println!("http://{}/", server.address()?);
            server.run();
        }
        _ => return Err(USAGE.into()),
    }
    Ok(())
}
