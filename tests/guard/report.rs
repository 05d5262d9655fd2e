//! What the report of the small pipeline draws and tells.

use std::path::PathBuf;

use crate::pipeline::{files, made};
use crate::snapshot::{check_each, redact};

fn short_hash(text: &str) -> String {
    blake3::hash(text.as_bytes()).to_hex()[..16].to_string()
}

/// What figures draw, apart from their titles: letters are drawn, too.
#[test]
fn figures() {
    let hash = |(name, path): (String, PathBuf)| {
        let svg = std::fs::read_to_string(path).unwrap();
        let drawn = svg.lines().filter(|line| !line.starts_with("<title>") && !line.starts_with("<desc>"));
        let drawn: String = drawn.flat_map(|line| [line, "\n"]).collect();
        format!("{name:60} {}\n", short_hash(&drawn))
    };
    let hashes = files(&made().folder.join("out/report"), "svg").into_iter().map(hash).collect();
    check_each("report", [("figures".to_string(), hashes)]);
}

/// The page with each element of these kinds replaced by a hash of it.
fn with_hashes(page: &str, elements: &[&str]) -> String {
    let mut text = page.to_string();
    for element in elements {
        let (open, close) = (format!("<{element}"), format!("</{element}>"));
        let mut rest = std::mem::take(&mut text);
        while let Some(start) = rest.find(&open) {
            let end = rest[start..].find(&close).unwrap() + start + close.len();
            let hash = short_hash(&rest[start..end]);
            text += &format!("{}\n[{element} {hash}]\n", &rest[..start]);
            rest = rest[end..].to_string();
        }
        text += &rest;
    }
    text
}

#[test]
fn page() {
    let page = std::fs::read_to_string(made().folder.join("out/report.html")).unwrap();
    let page = with_hashes(&redact(&page), &["script", "style", "svg", "table"]);
    let mut text = String::new();
    for piece in page.split('<') {
        text += piece.split_once('>').map_or(piece, |(_, after_tag)| after_tag);
        text.push('\n');
    }
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    check_each("report", [("page".to_string(), lines.flat_map(|line| [line, "\n"]).collect())]);
}
