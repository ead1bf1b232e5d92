//! A font of strokes: the letters that the show writes.

use glam::Vec3;

/// A line for each letter or digit: what it is, then points to be joined, and blanks where the pen is lifted. Points are
/// small letters, from a to c at the foot, then upwards, three in a row, to o.
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

/// The strokes of a text: the foot of its first letter at `corner`, letters along `right` and `up`, whose lengths are half a
/// letter's width and a quarter of its height.
pub fn write(text: &str, mut corner: Vec3, right: Vec3, up: Vec3) -> Vec<[Vec3; 2]> {
    let mut lines = Vec::new();
    for letter in text.bytes() {
        // To split the lines takes a searcher of 500 bytes.
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
