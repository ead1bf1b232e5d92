//! What the panel costs per picture, without a window: at rest, and while a slider is dragged.

use crate::app::App;
use crate::model::Model;
use crate::window::Events;
use std::path::PathBuf;
use std::time::Instant;
use testkit::median;

/// Pictures of each course.
const PICTURES: usize = 300;
/// Seconds from picture to picture.
const STEP: f64 = 1.0 / 60.0;

/// Times both courses and prints their medians and slowest hundredths.
pub fn run(model: Model, size: (usize, usize)) -> Result<(), String> {
    let mut app = App::new(model, PathBuf::from("."), None)?;
    app.model.playing = false;
    let (mut pixels, mut now) = (Vec::new(), 0.0);
    let mut course = |app: &mut App, mouse: &dyn Fn(usize) -> (Option<(f32, f32)>, bool)| {
        let mut times = Vec::new();
        for number in 0..PICTURES {
            let (mouse, down) = mouse(number);
            let events = Events { mouse, buttons: [down, false], active: true, ..Events::default() };
            now += STEP;
            let began = Instant::now();
            app.hear(&events, size, now, STEP);
            app.compose(&mut pixels, size, now);
            times.push(began.elapsed().as_secs_f64() * 1000.0);
        }
        times
    };
    // The first pictures rasterize the font.
    course(&mut app, &|_| (None, false));
    let rest = course(&mut app, &|_| (None, false));
    let before = app.model.values.clone();
    // Along the first slider of the scene, to and fro.
    let slider = app.first_slider().ok_or("the panel shows no slider at this size")?;
    let along = |number: usize| {
        let way = (number as f32 * 0.05).sin() * 0.5 + 0.5;
        slider.left() + way * slider.width()
    };
    let used = course(&mut app, &|number| (Some((along(number), slider.center().y)), number > 0));
    if app.model.values == before {
        return Err("the slider did not move".into());
    }
    for (what, times) in [("at rest", rest), ("in use", used)] {
        let mut sorted = times.clone();
        sorted.sort_by(f64::total_cmp);
        let slow = sorted[sorted.len() * 99 / 100];
        println!("{what}: {:.2} ms per picture of {}x{}, slowest hundredth {slow:.2}", median(times), size.0, size.1);
    }
    Ok(())
}
