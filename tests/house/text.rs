//! How long lines and files may be, and how the documentation begins.

use crate::{Source, assert_none, sources};

const MOST_COLUMNS: usize = 120;
const MOST_LINES: usize = 500;

/// First words that make riddles; "What" and its kin say what a thing does instead of what it is.
const BANNED_BEGINNINGS: [&str; 6] = ["What", "That of", "Those", "Of the", "So many", "All that"];

/// Words that are used nowhere in the documentation.
const BANNED_WORDS: [&str; 1] = ["anew"];

/// Beginnings of items that are not public: their documentation may begin as it likes.
const PRIVATE: [&str; 14] = [
    "pub(",
    "fn ",
    "const ",
    "static ",
    "struct ",
    "enum ",
    "trait ",
    "type ",
    "mod ",
    "impl",
    "unsafe ",
    "let ",
    "macro_rules!",
    "async ",
];

fn is_doc(line: &str) -> bool {
    line.starts_with("///") || line.starts_with("//!")
}

/// Returns whether the documentation above this line is public: of an item or field that is `pub`, of a variant, or of
/// a row of the settings' table.
fn is_public(item: &str) -> bool {
    let is_field = item.starts_with(|c: char| c.is_lowercase()) && !item.starts_with("pub ");
    let is_setting = item.contains("closed(") || item.contains("open(");
    !PRIVATE.iter().any(|start| item.starts_with(start)) && (!is_field || is_setting)
}

/// Places outside of tests whose documentation has a banned word, or begins with one.
fn riddles(sources: &[Source]) -> Vec<String> {
    let begins = |text: &str, with: &&str| {
        text.strip_prefix(*with).is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric()))
    };
    let mut found = Vec::new();
    let is_test = |file: &str| file.ends_with("tests.rs") || file.contains("tests/");
    for (file, source) in sources.iter().filter(|(file, _)| !is_test(file)) {
        let lines: Vec<&str> = source.lines().map(str::trim).collect();
        for (i, line) in lines.iter().enumerate().filter(|(_, line)| is_doc(line)) {
            let text = line[3..].trim_start();
            let mut words = text.split(|c: char| !c.is_alphanumeric());
            if words.any(|word| BANNED_WORDS.contains(&word)) {
                found.push(format!("{file}:{}: {text}", i + 1));
            }
            let item = lines[i..].iter().find(|line| !is_doc(line) && !line.starts_with('#')).copied();
            let is_first = i == 0 || !is_doc(lines[i - 1]);
            let is_public = line.starts_with("//!") || item.is_some_and(is_public);
            if is_first && is_public && BANNED_BEGINNINGS.iter().any(|with| begins(text, with)) {
                found.push(format!("{file}:{}: {text}", i + 1));
            }
        }
    }
    found
}

#[test]
fn no_line_is_too_long() {
    let mut found = Vec::new();
    for folder in ["src", "tests", "examples", "benches"] {
        for (file, source) in sources(folder) {
            let long = source.lines().enumerate().filter(|(_, line)| line.chars().count() > MOST_COLUMNS);
            found.extend(long.map(|(i, line)| format!("{folder}/{file}:{}: {}", i + 1, line.chars().count())));
        }
    }
    assert_none(&found, &format!("lines have at most {MOST_COLUMNS} columns"));
}

#[test]
fn no_file_of_the_crate_is_too_long() {
    let counted = sources("src").into_iter().map(|(file, source)| (file, source.lines().count()));
    let long = counted.filter(|&(_, lines)| lines > MOST_LINES);
    let found: Vec<String> = long.map(|(file, lines)| format!("src/{file}: {lines}")).collect();
    assert_none(&found, &format!("files have at most {MOST_LINES} lines"));
}

#[test]
fn documentation_of_public_items_is_no_riddle() {
    assert_none(&riddles(&sources("src")), "documentation begins with a verb or the noun that the item is");
}

#[test]
fn riddles_are_found() {
    let of = |source: &str| riddles(&[("a.rs".to_owned(), source.to_owned())]).len();
    assert_eq!(of("/// What it is.\n#[derive(A)]\npub struct A {\n    /// Those of it.\n    pub b: C,\n}"), 2);
    assert_eq!(of("//! What it does.\nenum E {\n    /// So many.\n    A,\n}"), 2);
    assert_eq!(of("/// That of all.\nmean: f32 = 2.1, closed(0.0, 1.0);"), 1);
    assert_eq!(of("/// Builds it\n/// anew.\nfn f() {}"), 1);
    assert_eq!(of("/// Whatever.\npub fn f() {}\n/// A sentence.\n/// What it says.\npub fn g() {}"), 0);
    assert_eq!(
        of("/// What is private.\nfn f() {}\n/// Those.\nfield: u32,\n// What a comment says.\npub fn g() {}"),
        0
    );
}
