//! The file of digests: a line each, with the film, the age, the digest and the reason.

use bevy_coating::sim::DIGEST_ALGORITHM;

#[derive(Clone, Debug, PartialEq)]
pub struct Digest {
    pub film: String,
    pub age: f64,
    /// The digest in 64 hexadecimal digits.
    pub hex: String,
    pub reason: String,
}

const HEAD: &str =
    "# Digests of the films of `films.rs`: film, age, digest, and the reason for which it became what it is.
# Written by `GOLDEN_REASON=\"...\" cargo core --test golden`.
";

fn algorithm_line() -> String {
    format!("algorithm {DIGEST_ALGORITHM}")
}

/// Reads the file. Every line must have a reason.
pub fn parse(text: &str) -> Result<Vec<Digest>, String> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let algorithm = lines.next().unwrap_or_default();
    if algorithm != algorithm_line() {
        return Err(format!("`{algorithm}` instead of `{}`: write the digests again", algorithm_line()));
    }
    lines.map(parse_line).collect()
}

fn parse_line(line: &str) -> Result<Digest, String> {
    let mut words = line.split_whitespace();
    let (film, age, hex) = (words.next(), words.next(), words.next());
    let (Some(film), Some(Ok(age)), Some(hex)) = (film, age.map(str::parse), hex) else {
        return Err(format!("no film, age and digest in `{line}`"));
    };
    if hex.len() != 64 || !hex.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return Err(format!("no digest in `{line}`"));
    }
    let reason = words.collect::<Vec<_>>().join(" ");
    check_reason(&reason)?;
    Ok(Digest { film: film.into(), age, hex: hex.into(), reason })
}

fn check_reason(reason: &str) -> Result<(), String> {
    let words = reason.split_whitespace().count();
    if words >= 3 { Ok(()) } else { Err(format!("`{reason}` is no reason: say in a few words what changed")) }
}

/// Writes the file with the digests `found`. Those that are known keep their reasons, the others have `reason`.
pub fn write(known: &[Digest], found: &[Digest], reason: &str) -> Result<String, String> {
    check_reason(reason)?;
    let mut text = format!("{HEAD}{}\n", algorithm_line());
    for Digest { film, age, hex, .. } in found {
        let same = known.iter().find(|known| (&known.film, known.age, &known.hex) == (film, *age, hex));
        let reason = same.map_or(reason, |known| &known.reason);
        text.push_str(&format!(
            "{film:8} {age:<4} {hex} {}\n",
            reason.split_whitespace().collect::<Vec<_>>().join(" ")
        ));
    }
    Ok(text)
}

#[test]
fn a_line_without_a_reason_is_refused() {
    let hex = "0123456789abcdef".repeat(4);
    let digest = |film: &str, age, hex: &str, reason: &str| Digest {
        film: film.into(),
        age,
        hex: hex.into(),
        reason: reason.into(),
    };
    let known = [digest("plate", 0.5, &hex, "The first of all.")];
    let text = write(&[], &known, "The first of all.").expect("a reason");
    assert_eq!(parse(&text).expect("as it was written"), known);
    // A digest that stays keeps its reason, one that changes gets the new one.
    let other = "f".repeat(64);
    let found = [known[0].clone(), digest("plate", 1.0, &other, "")];
    let text = write(&known, &found, "Cracks branch.  Now and then.").expect("a reason");
    let lines = parse(&text).expect("as it was written");
    assert_eq!(lines, [known[0].clone(), digest("plate", 1.0, &other, "Cracks branch. Now and then.")]);

    for wrong in ["", " so", " two words"] {
        let text = text.replace(" The first of all.", wrong);
        assert!(parse(&text).is_err_and(|error| error.contains("reason")), "`{wrong}`");
    }
    assert!(write(&[], &known, "because").is_err());
    assert!(parse(&text.replace("algorithm", "")).is_err_and(|error| error.contains("instead of")));
    assert!(parse(&text.replace("ffff", "ff")).is_err_and(|error| error.contains("no digest")));
    assert!(parse(&text.replace("plate", "")).is_err_and(|error| error.contains("no film")));
}
