//! The explorer: walk through every scene of Paprsek, and turn every knob.
//!
//! The main thread has the window, the keys and the panel; another one renders. Each takes the other's newest and waits
//! for nothing, so that the panel answers however long a frame takes. A frame is asked for by a [`request::Request`],
//! which is also the command line that reproduces it.

mod app;
mod args;
mod background;
mod calendar;
mod clicks;
mod compare;
mod file;
mod flight;
mod input;
mod keyframes;
mod keys;
mod model;
mod overlay;
mod painter;
mod panel;
mod patience;
mod probing;
mod record;
mod request;
mod state;
mod still;
mod timing;
mod watched;
mod window;
mod worker;

use app::App;
use args::Args;
use background::Background;
use clap::Parser;
use model::Model;
use paprsek::simd::level;
use state::States;
use std::process::ExitCode;
use std::thread::sleep;
use std::time::{Duration, Instant};
use window::Window;
use worker::Maker;

/// Shortest time from one look at the keys to the next.
const LOOK: Duration = Duration::from_millis(8);
/// Longest time that counts as one step: what a stopped process missed is not flown.
const LONGEST: f64 = 0.25;

fn main() -> ExitCode {
    match run(Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("explorer: {why}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: Args) -> Result<(), String> {
    let simd = level::all().first().map_or("", |best| best.0);
    let mut model = Model::new(args.scene, args.threads, simd);
    if let Some(time) = args.at {
        (model.time, model.playing) = (time, false);
        model.seek(0.0);
    }
    if let Some(path) = &args.load {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        file::read(&mut model, &text).map_err(|why| format!("{}, {why}", path.display()))?;
    }
    if args.time_panel {
        return timing::run(model, args.size);
    }
    let mut states = args.state.as_deref().map(States::open).transpose()?;
    let mut window = Window::open(args.size)?;
    let mut maker = Maker::default();
    let worker = Background::start(move |(request, overlay)| maker.frame(request, overlay, |_| {}))?;
    let (mut app, mut asked) = (App::new(model, args.out, args.pipe)?, None);
    let (began, mut last) = (Instant::now(), 0.0);
    let (mut pixels, mut size) = (Vec::new(), (0, 0));
    // When the next frame may be asked for, seconds.
    let mut next = 0.0;
    while !app.ends {
        let now = began.elapsed().as_secs_f64();
        let resized = std::mem::replace(&mut size, window.size()) != size;
        let events = window.events();
        if events.gone {
            // Before Xlib hears of it, which would end the process then and there.
            let ended = app.end();
            return Err(ended.err().unwrap_or_else(|| "the display has gone".into()));
        }
        let mut fresh = app.hear(&events, size, now, (now - last).min(LONGEST)) | resized;
        last = now;
        let request = (app.model.request(size), app.overlay);
        if asked.as_ref() != Some(&request) && now >= next {
            // A recording waits for nothing; who is late by more than a frame does not catch up.
            let pace = if app.recording.is_some() { 0.0 } else { app.model.pace() };
            next = if now < next + pace { next + pace } else { now + pace };
            asked = Some(request.clone());
            worker.ask(request);
        }
        if let Some(shown) = worker.take().transpose()? {
            app.show(shown, now);
            fresh = true;
        }
        fresh |= app.study(now)?;
        if fresh {
            app.compose(&mut pixels, size, now);
            window.show(&pixels, size)?;
            if let Some(states) = &mut states {
                states.write(&app, size);
            }
        } else {
            window.look();
        }
        let spent = began.elapsed().as_secs_f64() - now;
        // A frame that is due earlier is not kept waiting.
        let wait =
            if app.model.playing && next > now { LOOK.as_secs_f64().min(next - now) } else { LOOK.as_secs_f64() };
        sleep(Duration::from_secs_f64((wait - spent).max(0.0)));
    }
    app.end()
}
