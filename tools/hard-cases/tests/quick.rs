//! Every hard case with a few inputs, and a short walk.

use hard_cases::{CHAPTERS, Effort, walk};

#[test]
fn hard_cases_hold() {
    let outcomes = CHAPTERS.iter().flat_map(|chapter| chapter.1).map(|case| case.run(&Effort::QUICK));
    let failed: Vec<String> = outcomes.filter(|outcome| !outcome.holds()).map(|outcome| outcome.line()).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn the_page_has_every_case() {
    let page = include_str!("../../../docs/hard-cases.md");
    let mut names: Vec<&str> = CHAPTERS.iter().flat_map(|chapter| chapter.1).map(|case| case.name).collect();
    for name in &names {
        assert!(page.contains(&format!("| {name} |")), "docs/hard-cases.md lacks: {name}");
    }
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count, "two cases have one name");
    assert!(count >= 120, "{count} cases");
}

#[test]
fn a_short_walk_stays_finite() {
    assert!(walk::walk(&walk::Options { frames: 40, seed: 1, first: 0, keep: false }));
}
