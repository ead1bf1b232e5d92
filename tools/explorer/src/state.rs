//! A line about each picture that is shown, for programs that drive the explorer.

use crate::app::App;
use std::fs::File;
use std::io::{Write, stdout};
use std::path::Path;

/// Where the lines go.
pub struct States {
    to: Box<dyn Write>,
    count: u64,
}

impl States {
    /// Lines into a file, or to stdout where it is `-`.
    pub fn open(path: &Path) -> Result<States, String> {
        let to: Box<dyn Write> = if path.as_os_str() == "-" {
            Box::new(stdout())
        } else {
            Box::new(File::create(path).map_err(|error| format!("{}: {error}", path.display()))?)
        };
        Ok(States { to, count: 0 })
    }

    /// Writes the line of a picture that has been shown. Words are `name=value`; the last is the command line.
    pub fn write(&mut self, app: &App, size: (usize, usize)) {
        self.count += 1;
        let model = &app.model;
        let Some(shown) = &app.shown else { return };
        let request = &shown.request;
        let pose = shown.placed.camera.map_or_else(String::new, |pose| {
            let numbers = paprsek::frame::placement::numbers(&pose).map(|number| format!("{number:.4}"));
            numbers.join(",")
        });
        let plane = shown.placed.plane.map_or_else(String::new, |pose| {
            let numbers = paprsek::frame::placement::numbers(&pose).map(|number| format!("{number:.4}"));
            numbers[..6].join(",")
        });
        let flag = u8::from;
        let slider = app.first_slider().map_or_else(String::new, |slider| {
            format!("{:.0},{:.0},{:.0}", slider.left(), slider.center().y, slider.width())
        });
        // Off, under way, or what was found.
        let compare = match app.compare.of(request) {
            _ if !app.compare.on => "off".into(),
            Some(found) => format!("{:.2}", found.difference.psnr()),
            None => format!("{:.0}%", 100.0 * app.compare.progress()),
        };
        let probe = app.probing.told.as_ref().filter(|_| app.probing.on);
        let probe = probe.map_or("off".into(), |((x, y), text)| format!("{x},{y},{}", text.lines().count()));
        let (mouse_x, mouse_y) = app.mouse_at().unwrap_or((-1.0, -1.0));
        let line = format!(
            "picture={} size={}x{} scene={} time={:.3} playing={} rate={} camera={pose} own={} plane={plane} flight={} \
             speed={:.3} panel={} help={} times={} overlay={} compare={compare} probe={probe} recorded={} told={} keys={} slider={slider} mouse={mouse_x:.0},{mouse_y:.0} threads={} simd={} cap={} frames={} ms={:.3} words={}",
            self.count,
            size.0,
            size.1,
            request.scene.name,
            request.time,
            flag(model.playing),
            model.rate,
            flag(model.pose.is_none() && model.flight.is_none()),
            model.flight.map_or(0, |flight| 2 - flag(flight.first_person)),
            model.speed,
            flag(app.panel),
            flag(app.help),
            flag(app.times),
            shown.coloured.as_ref().map_or("none", |coloured| coloured.overlay.about().0).replace(' ', "-"),
            app.recording.as_ref().map_or("off".into(), |recording| recording.count.to_string()),
            app.told().unwrap_or("nothing").replace([' ', '\n'], "_"),
            model.keys.keys().len(),
            shown.threads,
            request.simd,
            model.cap,
            app.frames,
            shown.ms,
            request.words(),
        );
        // Who no longer reads does not stop the explorer.
        let _ = writeln!(self.to, "{line}").and_then(|()| self.to.flush());
    }
}
