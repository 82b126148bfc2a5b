//! Links of the README and the guide lead somewhere, in the repository and on docs.rs; and what the guide says of the
//! log is what the log says.

use std::{collections::BTreeSet, fs, path::Path};

use crate::{assert_none, read, sources};

/// Pages of pictures, which are in the repository only.
const PICTURES: [&str; 2] = ["gallery", "looks"];

/// Names of the pages of the guide, without their ending.
fn pages() -> Vec<String> {
    let entries = fs::read_dir("docs").expect("the folder docs");
    let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    let mut pages: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".md")?.to_owned())).collect();
    pages.retain(|page| !PICTURES.contains(&page.as_str()));
    pages.sort();
    pages
}

/// Text without blocks of code, whose brackets are no links.
fn prose(text: &str) -> String {
    let blocks = text.split("```").step_by(2);
    blocks.map(|block| block.split('`').step_by(2).collect::<Vec<_>>().join("`")).collect()
}

/// Destinations of links that are written beside their text: `[text](destination)`.
fn inline_links(text: &str) -> Vec<String> {
    let ends = text.match_indices("](").map(|(at, _)| &text[at + 2..]);
    ends.filter_map(|rest| Some(rest.split_once(')')?.0.to_owned())).collect()
}

/// Labels and destinations of links that are written below: `[label]: destination`.
fn defined_links(text: &str) -> Vec<(String, String)> {
    let lines = text.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: "));
    lines.map(|(label, to)| (label.to_lowercase(), to.trim().to_owned())).collect()
}

fn is_absolute(destination: &str) -> bool {
    ["https://", "http://", "crate::", "#"].iter().any(|start| destination.starts_with(start))
}

/// Links of a page of the guide that do not lead to a page, there or on docs.rs, where `macro_links` counts.
fn faults_of_page(text: &str, macro_links: &BTreeSet<String>, exists: impl Fn(&str) -> bool) -> Vec<String> {
    let text = prose(text);
    let mut found = Vec::new();
    for to in inline_links(&text).into_iter().filter(|to| !is_absolute(to)) {
        found.push(format!("`({to})` leads nowhere on docs.rs: define it below, as `[label]: {to}`"));
    }
    let defined = defined_links(&text);
    for (label, to) in defined.iter().filter(|(_, to)| !is_absolute(to)) {
        if !exists(to) {
            found.push(format!("[{label}]: {to} is not there"));
        }
        if !macro_links.contains(label) {
            found.push(format!("[{label}] is not among the links of src/guide.rs"));
        }
    }
    // Lines may be broken within a label.
    let flat = text.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
    for label in macro_links.iter().filter(|label| defined.iter().all(|(known, _)| known != *label)) {
        let label_is_used = flat.split(&format!("[{label}]")).skip(1).any(|rest| !rest.starts_with('('));
        if label_is_used {
            found.push(format!("[{label}] is not defined below, so it is no link in the repository"));
        }
    }
    found
}

#[test]
fn every_link_of_the_guide_leads_to_a_page() {
    let guide = read("src/guide.rs");
    let macro_links: BTreeSet<String> =
        defined_links(&guide.replace("        \"[", "[")).into_iter().map(|l| l.0).collect();
    assert!(macro_links.len() > 10, "{macro_links:?}");
    let mut found = Vec::new();
    for page in pages() {
        let exists = |to: &str| Path::new("docs").join(to).exists();
        let faults = faults_of_page(&read(&format!("docs/{page}.md")), &macro_links, exists);
        found.extend(faults.into_iter().map(|fault| format!("docs/{page}.md: {fault}")));
    }
    assert_none(&found, "links of the guide lead to its pages, in the repository and on docs.rs");
}

#[test]
fn every_page_is_a_module_and_listed() {
    let guide = read("src/guide.rs");
    let mut found = Vec::new();
    for page in pages() {
        for needed in [format!("pub mod {page} {{}}"), format!("docs/{page}.md"), format!("//! | [`{page}`] |")] {
            if !guide.contains(&needed) {
                found.push(format!("src/guide.rs lacks `{needed}`"));
            }
        }
    }
    assert_none(&found, "each page of docs is a module of the guide");
}

#[test]
fn every_relative_link_of_the_other_texts_is_there() {
    let mut found = Vec::new();
    let texts = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "assets/ATTRIBUTION.md"];
    let pictures = PICTURES.map(|page| format!("docs/{page}.md"));
    let pictures = pictures.iter().map(String::as_str).filter(|page| Path::new(page).exists());
    for file in texts.into_iter().chain(["examples/README.md"]).chain(pictures) {
        let text = prose(&read(file));
        let folder = Path::new(file).parent().expect("a folder");
        let links = inline_links(&text).into_iter().chain(defined_links(&text).into_iter().map(|link| link.1));
        for to in links.filter(|to| !is_absolute(to)) {
            if !folder.join(to.split('#').next().expect("a path")).exists() {
                found.push(format!("{file}: {to}"));
            }
        }
    }
    assert_none(&found, "relative links lead to files");
}

#[test]
fn what_troubleshooting_says_of_the_log_is_in_the_sources() {
    let page = read("docs/troubleshooting.md");
    let table = page.split("## What the log says").nth(1).expect("the last part");
    let rows: Vec<&str> =
        table.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next()).skip(1).collect();
    assert!(rows.len() > 20, "the table was not found");
    // Texts are broken over lines by a backslash.
    let all: String = sources("src").into_iter().map(|(_, text)| text).collect();
    let all = all.split('\\').map(|part| part.trim_start_matches(['\n', ' '])).collect::<Vec<_>>().join("");
    let mut found = Vec::new();
    for row in rows {
        // Numbers and names stand for what differs.
        let words = row.replace(" N ", " ... ").replace(" M ", " ... ");
        for part in words.split("...").map(|part| part.trim_matches([' ', '`', '(', ')', ';', ','])) {
            if part.len() > 5 && !all.contains(part) {
                found.push(format!("`{part}` of `{row}`"));
            }
        }
    }
    assert_none(&found, "the guide quotes the log");
}

#[test]
fn links_are_read() {
    let text = "[Of\nit] [a](b.md) and [`c`](crate::C)\n```\n[x](y)\n```\n[Settings] `[z](w)`\n\
                [settings]: settings.md\n[d]: d.md\n";
    let known = BTreeSet::from(["settings", "of it"].map(str::to_owned));
    let faults = faults_of_page(text, &known, |to| to == "settings.md");
    assert_eq!(faults.len(), 4, "{faults:?}");
    assert_eq!(inline_links("[a](b) [c] (d) [e](f#g)"), ["b", "f#g"]);
    let text = prose("a `b` c\n```\nd\n```\ne");
    assert!(!text.contains(['b', 'd']) && text.contains('c') && text.contains('e'), "{text}");
}
