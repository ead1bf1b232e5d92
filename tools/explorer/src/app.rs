//! The explorer between the window and the renderer: keys and the mouse change the model, and pictures are put together.

use crate::compare::Compare;
use crate::flight::Stick;
use crate::input::{Input, Pressed};
use crate::keys::{self, Action};
use crate::model::Model;
use crate::overlay::Overlay;
use crate::painter::Painter;
use crate::panel::{self, Graph, Turned};
use crate::probing::Probing;
use crate::record::{self, Ending, Recording};
use crate::request::milliseconds;
use crate::still;
use crate::window::Events;
use crate::worker::Shown;
use egui::{Context, RawInput, Rect};
use minifb::Key;
use std::path::PathBuf;

/// Seconds after which a frame that stays the same is compared.
const REST: f64 = 0.3;
/// Seconds after which the progress of a comparison is shown anew.
const PROGRESS: f64 = 0.2;
/// Seconds that something told is shown.
const TOLD: f64 = 4.0;

/// Everything but the window and the thread that renders.
pub struct App {
    /// What is shown.
    pub model: Model,
    /// The frame that is shown.
    pub shown: Option<Shown>,
    /// Frames that have been rendered.
    pub frames: u64,
    /// Whether to end.
    pub ends: bool,
    /// Whether the help is shown.
    pub help: bool,
    /// Whether the panel is shown.
    pub panel: bool,
    /// Whether the graph of frame times is shown.
    pub times: bool,
    /// What is shown over the picture.
    pub overlay: Option<Overlay>,
    /// The comparison with the truth.
    pub compare: Compare,
    /// The probe of the pixel under the mouse.
    pub probing: Probing,
    /// Since when the frame that is shown has been the same, seconds.
    since: f64,
    hud: bool,
    graph: Graph,
    turned: Turned,
    told: Option<(String, f64)>,
    /// The recording that is under way.
    pub recording: Option<Recording>,
    /// The recording that has taken its last frame, and is still being written.
    ending: Option<Ending>,
    pipe: Option<String>,
    out: PathBuf,
    clipboard: Option<arboard::Clipboard>,
    ctx: Context,
    painter: Painter,
    input: Input,
    /// What egui has not heard yet.
    waiting: RawInput,
    /// When egui wants to draw again, seconds.
    repaint: f64,
    /// Whether the left button went down over the picture.
    drags: bool,
}

impl App {
    /// An explorer that has shown nothing yet. It writes files into `out`, and recordings into `pipe` if there is one.
    pub fn new(model: Model, out: PathBuf, pipe: Option<String>) -> Result<App, String> {
        let ctx = Context::default();
        panel::dress(&ctx);
        Ok(App {
            model,
            shown: None,
            frames: 0,
            ends: false,
            help: false,
            panel: true,
            times: false,
            overlay: None,
            compare: Compare::new()?,
            probing: Probing::new()?,
            since: 0.0,
            hud: true,
            graph: Graph::default(),
            turned: Turned::default(),
            told: None,
            recording: None,
            ending: None,
            pipe,
            out,
            clipboard: None,
            ctx,
            painter: Painter::new(),
            input: Input::default(),
            waiting: RawInput::default(),
            repaint: 0.0,
            drags: false,
        })
    }

    /// Hears events at `now`, seconds since the start, `seconds` after the last ones. Gives whether there is something
    /// new to draw.
    pub fn hear(&mut self, events: &Events, size: (usize, usize), now: f64, seconds: f64) -> bool {
        let (raw, pressed) = self.input.take(events, size, panel::scale(size.1), now);
        // Keys that egui has no use for change what is drawn, too.
        let fresh = !raw.events.is_empty() || !pressed.is_empty();
        self.waiting.append(raw);
        self.ends |= events.closed;
        let typing = self.ctx.wants_keyboard_input();
        if !typing {
            for &Pressed { key, repeated, shift, ctrl } in &pressed {
                let action = keys::action(key, shift, ctrl);
                if let Some(action) = action.filter(|action| !repeated || keys::repeats(*action)) {
                    self.act(action, now);
                }
            }
        } else if pressed.iter().any(|pressed| pressed.key == Key::Escape) {
            self.ctx.memory_mut(|memory| memory.stop_text_input());
        }
        self.mouse(events, size);
        let stick = self.hold(typing, seconds);
        // A recording moves time on by itself, once it has the frame of that time.
        let has = |shown: &Shown| shown.request.time == milliseconds(self.model.time);
        let room = self.recording.as_ref().is_some_and(Recording::has_room);
        if room && self.model.playing && self.shown.as_ref().is_some_and(has) {
            self.model.seek(self.model.rate / record::RATE);
        }
        let playing = self.model.playing;
        self.model.playing = playing && self.recording.is_none();
        self.model.advance(seconds, stick);
        self.model.playing = playing;
        let told = self.look_after(now);
        fresh || told || now >= self.repaint
    }

    /// Looks after recordings that have failed or are complete. Gives whether there is something to tell.
    fn look_after(&mut self, now: f64) -> bool {
        let failed = self.recording.as_ref().is_some_and(Recording::has_failed);
        if failed {
            self.record(now);
        }
        let over = self.ending.take_if(|ending| ending.is_over());
        let told = over.is_some();
        if let Some(ending) = over {
            let told = ending.told();
            if let Err(why) = &told {
                eprintln!("explorer: recording: {why}");
            }
            self.tell(told.unwrap_or_else(|why| format!("recording: {why}")), now);
        }
        failed || told
    }

    /// Walks while keys are held; gives the stick.
    fn hold(&mut self, typing: bool, seconds: f64) -> Stick {
        let axis = |up, down| {
            if typing {
                0.0
            } else {
                f64::from(u8::from(self.input.held(up))) - f64::from(u8::from(self.input.held(down)))
            }
        };
        let way = [axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S)];
        // The stick is pulled to climb.
        let stick = Stick { up: axis(Key::Down, Key::Up), right: axis(Key::Right, Key::Left), faster: way[2] };
        let factor = if self.input.shift() {
            10.0
        } else if self.input.ctrl() {
            0.1
        } else {
            1.0
        };
        if way != [0.0; 3] && self.model.flight.is_none() {
            let step = self.model.speed * factor * seconds;
            self.model.walk(way.map(|part| part * step));
        }
        stick
    }

    /// Looks around and scrolls, where the mouse is not over the panel.
    fn mouse(&mut self, events: &Events, size: (usize, usize)) {
        let over = self.ctx.wants_pointer_input() || self.ctx.is_pointer_over_area();
        let down = self.input.buttons()[0] || self.input.buttons()[1];
        let dragged = self.drags;
        self.drags = down && (dragged || !over);
        // On its way to where the button went down the mouse did not drag yet.
        if self.drags && dragged && self.input.moved != (0.0, 0.0) {
            self.model.look(self.input.moved, size.1);
        }
        if events.wheel != 0.0 && !over {
            self.model.wheel(f64::from(events.wheel.clamp(-8.0, 8.0)), self.input.ctrl());
        }
    }

    fn act(&mut self, action: Action, now: f64) {
        match action {
            Action::Help => self.help = !self.help,
            Action::Panel => self.panel = !self.panel,
            Action::Overlay(by) => self.overlay = Overlay::next(self.overlay, by),
            Action::Compare => self.compare.on = !self.compare.on,
            Action::Probe => self.probing.on = !self.probing.on,
            Action::Times => self.times = !self.times,
            Action::Hud => self.hud = !self.hud,
            Action::Copy => self.copy(now),
            Action::Still => self.still(now),
            Action::Record => self.record(now),
            Action::Quit if self.help => self.help = false,
            Action::Quit if self.probing.on => self.probing.on = false,
            Action::Quit if self.compare.on => self.compare.on = false,
            Action::Quit if self.overlay.is_some() => self.overlay = None,
            Action::Quit => self.ends = true,
            _ => self.model.act(action),
        }
    }

    /// Copies the frame that is shown as a command line, to the clipboard and to stdout.
    fn copy(&mut self, now: f64) {
        let Some(shown) = &self.shown else { return };
        let command = shown.request.command();
        self.put(command, "command line", now);
    }

    /// Puts a text on the clipboard, and on stdout for where there is none.
    fn put(&mut self, text: String, what: &str, now: f64) {
        println!("{}", text.trim_end());
        if self.clipboard.is_none() {
            self.clipboard = arboard::Clipboard::new().ok();
        }
        let copied = self.clipboard.as_mut().is_some_and(|clipboard| clipboard.set_text(text).is_ok());
        self.tell(if copied { format!("copied: {what}") } else { format!("on stdout: {what}") }, now);
    }

    fn still(&mut self, now: f64) {
        let Some(shown) = &self.shown else { return };
        let saved = still::save(&self.out, shown);
        self.tell(saved.map_or_else(|why| why, |path| format!("saved {}", path.display())), now);
    }

    /// Begins to record, or ends it.
    fn record(&mut self, now: f64) {
        let Some(shown) = &self.shown else { return };
        let told = match self.recording.take() {
            Some(recording) => {
                self.ending = Some(recording.end());
                Ok("writing what is left".into())
            }
            None if self.ending.is_some() => Err("the last recording is still being written".into()),
            None => {
                let size = (shown.frame.width, shown.frame.height);
                Recording::start(&self.out, self.pipe.as_deref(), size).map(|recording| {
                    let told = format!("recording into {}; F9 ends it", recording.name);
                    self.recording = Some(recording);
                    self.keep(now);
                    told
                })
            }
        };
        self.tell(told.unwrap_or_else(|why| why), now);
    }

    /// Gives the frame that is shown to the recording.
    fn keep(&mut self, now: f64) {
        let (Some(recording), Some(shown)) = (&mut self.recording, &self.shown) else { return };
        let frame = &shown.frame;
        // A frame of another size ends it.
        if (frame.width, frame.height) == recording.size {
            recording.take(frame);
        } else {
            self.record(now);
        }
    }

    /// Ends what is under way.
    pub fn end(&mut self) -> Result<(), String> {
        let left = self.recording.take().map(Recording::end).or(self.ending.take());
        left.map_or(Ok(()), |ending| ending.wait().map(drop))
    }

    /// What is told now.
    pub fn told(&self) -> Option<&str> {
        self.told.as_ref().map(|told| &*told.0)
    }

    fn tell(&mut self, what: String, now: f64) {
        self.told = Some((what, now + TOLD));
    }

    /// Puts a picture together: the frame, and what is drawn over it.
    pub fn compose(&mut self, pixels: &mut Vec<u32>, size: (usize, usize), now: f64) {
        pixels.resize(size.0 * size.1, 0);
        match &self.shown {
            Some(shown) => {
                let frame = &shown.frame;
                let found = self.compare.of(&shown.request).filter(|_| (frame.width, frame.height) == size);
                match (&shown.coloured, found) {
                    (_, Some(found)) => {
                        pixels.copy_from_slice(&frame.pixels);
                        self.compare.draw(found, frame, pixels);
                    }
                    (Some(coloured), None) => still::fit(&coloured.pixels, (frame.width, frame.height), pixels, size),
                    (None, None) => still::fit(&frame.pixels, (frame.width, frame.height), pixels, size),
                }
            }
            None => pixels.fill(0),
        }
        let scale = panel::scale(size.1);
        self.ctx.set_pixels_per_point(scale);
        let raw = std::mem::take(&mut self.waiting);
        self.told = self.told.take().filter(|told| now < told.1);
        let ctx = self.ctx.clone();
        let output = ctx.run(raw, |ctx| self.draw(ctx));
        if let Some(told) = self.turned.told.take() {
            self.tell(told, now);
        }
        if let Some(rows) = self.turned.rows.take() {
            self.put(rows, "rows of keys", now);
        }
        if std::mem::take(&mut self.turned.copy) {
            self.copy(now);
        }
        let wait =
            output.viewport_output.values().map(|view| view.repaint_delay.as_secs_f64()).fold(f64::INFINITY, f64::min);
        // What has been told goes away by itself.
        let told = self.told.as_ref().map_or(f64::INFINITY, |told| told.1);
        let progress = if self.is_comparing() { now + PROGRESS } else { f64::INFINITY };
        self.repaint = told.min(progress).min(now + wait);
        self.painter.paint(&self.ctx, output, pixels, size);
    }

    fn draw(&mut self, ctx: &Context) {
        // A small picture has room for one thing at a time.
        let narrow = panel::is_narrow(ctx);
        let panel = self.panel && !(narrow && self.help);
        let free = !narrow || !(panel || self.help);
        if panel {
            panel::panel(ctx, &mut self.turned, &mut self.model, &mut self.overlay, &self.out);
        }
        if self.hud && free && !(narrow && self.times) {
            let told = self.told.as_ref().map(|told| &*told.0);
            panel::hud(ctx, &self.model, self.shown.as_ref(), told);
        }
        let mut above = 0.0;
        if self.times && free {
            above = self.graph.show(ctx, self.shown.as_ref().map_or(0, |shown| shown.samples));
        }
        if let Some(coloured) = self.shown.as_ref().and_then(|shown| shown.coloured.as_ref()).filter(|_| free) {
            panel::legend(ctx, coloured, above);
        }
        if self.compare.on && free {
            panel::compared(ctx, &mut self.compare, self.shown.as_ref());
        }
        if self.probing.on && free {
            panel::probed(ctx, &self.probing);
        }
        if self.help {
            panel::help(ctx, &self.model);
        }
    }

    /// Looks after what is found out about the frame that is shown. Gives whether there is something new to draw.
    pub fn study(&mut self, now: f64) -> Result<bool, String> {
        let Some(shown) = &self.shown else { return Ok(false) };
        let rests = now - self.since > REST;
        let compared = self.compare.look(&shown.request, &shown.frame, rests)?;
        // The mouse over the panel is not over the picture.
        let mouse = self.input.mouse().filter(|_| !self.ctx.is_pointer_over_area());
        let probed = self.probing.look(&shown.request, mouse)?;
        Ok(compared || probed)
    }

    /// Whether the truth is being rendered.
    fn is_comparing(&self) -> bool {
        self.compare.on && self.shown.as_ref().is_some_and(|shown| self.compare.of(&shown.request).is_none())
    }

    /// Takes a new frame.
    pub fn show(&mut self, shown: Shown, now: f64) {
        // A frame of a scene that has been left says nothing about this one.
        if shown.request.scene.name == self.model.scene.name {
            self.model.placed = shown.placed;
        }
        if self.shown.as_ref().is_some_and(|last| last.request.scene.name != shown.request.scene.name) {
            self.graph.clear();
        }
        if self.shown.as_ref().is_none_or(|last| last.request != shown.request) {
            self.since = now;
        }
        self.frames += 1;
        self.graph.take(&shown);
        self.shown = Some(shown);
        self.keep(now);
    }

    /// Where the panel's first slider of the scene is, pixels.
    pub fn first_slider(&self) -> Option<Rect> {
        self.turned
            .slider
            .filter(|_| self.panel && !(self.help && panel::is_narrow(&self.ctx)))
            .map(|slider| slider * self.ctx.pixels_per_point())
    }

    /// Where the mouse is, pixels.
    pub fn mouse_at(&self) -> Option<(f32, f32)> {
        self.input.mouse()
    }
}
