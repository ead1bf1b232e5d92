//! One HTML file of all pages, with their pictures in it. It needs no script, no network and nothing beside it.

use crate::options::Result;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html};
use std::fs;
use std::path::Path;

/// Readable in light and in dark; pictures and curves keep a white ground.
const STYLE: &str = include_str!("report.css");

/// The pages in reading order, by their files in the report's folder, with their titles in the table of contents.
const PAGES: [(&str, &str); 14] = [
    ("unseen.md", "Default quality, instants not tuned on"),
    ("fronts.md", "Fronts, with peers"),
    ("report.md", "Every knob"),
    ("films.md", "Films: flicker and popping"),
    ("not-modelled.md", "What is not modelled"),
    ("levels.md", "Every SIMD level"),
    ("show.md", "The show, part by part"),
    ("beside.md", "Beside an earlier commit"),
    ("roofline.md", "Roofline"),
    ("shadows.md", "Shadow maps"),
    ("lights.md", "Objects and lights"),
    ("particles.md", "Particles"),
    ("imposters.md", "Clouds as pictures"),
    ("../hard-cases.md", "Hard cases"),
];

/// Binds the pages of a folder that are there into `file`. `about` is the paragraph on top.
pub fn bind(folder: &Path, file: &Path, about: &str) -> Result {
    let (mut contents, mut body) = (String::new(), String::new());
    for (number, (page, title)) in PAGES.iter().enumerate() {
        let path = folder.join(page);
        let Ok(text) = fs::read_to_string(&path) else { continue };
        contents += &format!("<li><a href=\"#page{number}\">{title}</a></li>\n");
        let mut events = Vec::new();
        let mut parser = Parser::new_ext(&text, Options::ENABLE_TABLES);
        while let Some(event) = parser.next() {
            if let Event::Start(Tag::Image { dest_url, .. }) = &event {
                let caption: String = parser
                    .by_ref()
                    .take_while(|event| !matches!(event, Event::End(TagEnd::Image)))
                    .filter_map(|event| if let Event::Text(text) = event { Some(text.to_string()) } else { None })
                    .collect();
                events.push(Event::InlineHtml(CowStr::from(picture(&path.with_file_name(&**dest_url), &caption))));
            } else {
                events.push(event);
            }
        }
        body += &format!("<section id=\"page{number}\">\n");
        html::push_html(&mut body, events.into_iter());
        body += "</section>\n";
    }
    // Wide tables scroll by themselves, not the page.
    let body = body.replace("<table>", "<div class=\"wide\"><table>").replace("</table>", "</table></div>");
    let document = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>Paprsek: speed and error</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<header><h1>Paprsek: speed and error</h1>\n<p>{about}</p>\n\
         <nav><ol>\n{contents}</ol></nav></header>\n<main>\n{body}</main>\n</body>\n</html>\n"
    );
    if let Some(parent) = file.parent() {
        fs::create_dir_all(parent)?;
    }
    Ok(fs::write(file, document)?)
}

/// A picture as part of the document: curves as SVG, everything else by its bytes.
fn picture(path: &Path, caption: &str) -> String {
    let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
    match fs::read(path) {
        Err(error) => format!("<em>{caption}: {error}</em>"),
        // From the tag on: an XML declaration has no place inside of HTML.
        Ok(bytes) if extension == "svg" => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let start = text.find("<svg").unwrap_or(0);
            let (tag, rest) = text[start..].split_at(4);
            format!("<span class=\"curve\" role=\"img\" aria-label=\"{caption}\">{tag}{rest}</span>")
        }
        Ok(bytes) => {
            format!("<img alt=\"{caption}\" src=\"data:image/{extension};base64,{}\">", STANDARD.encode(bytes))
        }
    }
}
