//! A font of strokes, with the letters and digits that the show writes.

use glam::Vec3A;

/// A line per letter or digit: its name, then the points that a stroke joins, with a blank where the pen is lifted.
/// Points are small letters, three in a row, from `a` to `c` at the foot up to `m` to `o` at the top.
const GLYPHS: &str = "\
4mgi oc
6omacig
Aagnic gi
Bamnlhg hfba
Ccamo
Ecamo gh
Famo gh
Ham co gi
Ibn
Kam ogc
Namco
Oamoca
Pamnlhg
Ramnlhg hc
Sonjfba
Tbn mo
Vmbo
Wmaeco";

/// The strokes of a text, each from one point to another. The foot of the first letter is at `corner`; `right` is half
/// of a letter's width, `up` a quarter of its height.
pub fn write(text: &str, mut corner: Vec3A, right: Vec3A, up: Vec3A) -> Vec<[Vec3A; 2]> {
    let mut lines = Vec::new();
    for letter in text.bytes() {
        // One pass over all bytes, as splitting into lines takes a searcher of 500 bytes in the 64 kB build.
        let (mut this, mut last) = (false, None);
        for point in GLYPHS.bytes() {
            if point > b' ' && point < b'a' {
                this = point == letter;
            }
            let next = (point >= b'a').then(|| {
                let k = (point - b'a') as u32;
                corner + right * (k % 3) as f32 + up * (k / 3) as f32
            });
            if let (Some(from), Some(to), true) = (last, next, this) {
                lines.push([from, to]);
            }
            last = next;
        }
        corner += right * 3.0;
    }
    lines
}
