//! One HTML page that needs nothing else: style, fonts, scripts, figures and data stand in it.

mod base64;
mod data;
mod tables;

use std::fmt::Write;

use super::figure::Figure;
use super::font::Face;
use super::label::escape;
use super::material::{File, Material};
use super::number;
use super::svg::{Place, svg};
use base64::base64;

const STYLE: &str = include_str!("../assets/page.css");
const PLOT_STYLE: &str = include_str!("../assets/uPlot.min.css");
const PLOT_LICENSE: &str = include_str!("../assets/uPlot.LICENSE");
const SCRIPTS: [&str; 6] = [
    include_str!("../assets/uPlot.iife.min.js"),
    include_str!("../assets/normal.js"),
    include_str!("../assets/fragility.js"),
    include_str!("../assets/calculator.js"),
    include_str!("../assets/planes.js"),
    include_str!("../assets/motions.js"),
];

/// What a page says of itself besides the material.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The figures in order.
    pub figures: &'a [Figure],
    /// The folder of their files, as a link from the page.
    pub folder: &'a str,
    /// What made the page, for whoever asks whether it is up to date: a JSON object.
    pub stamp: &'a str,
}

/// The page.
pub fn page(material: &Material, Page { figures, folder, stamp }: Page) -> String {
    let mut html = String::with_capacity(1 << 20);
    html.push_str("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    // Read back by the stage: it must stay near the start.
    let _ = writeln!(html, "<meta name=\"rockfrag\" content=\"{}\">", escape(stamp));
    html.push_str("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    html.push_str(
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Rocking fragility report</title>\n",
    );
    html.push_str("<link rel=\"icon\" href=\"data:,\">\n<style>\n");
    for (face, style) in Face::ALL.into_iter().zip(["400", "400;font-style:italic", "600"]) {
        let _ = writeln!(
            html,
            "@font-face{{font-family:\"Fira Sans\";font-weight:{style};src:url(data:font/ttf;base64,{})}}",
            base64(face.file())
        );
    }
    html.push_str(PLOT_STYLE);
    html.push_str(STYLE);
    html.push_str("</style>\n</head>\n<body>\n");
    header(&mut html, material);
    html.push_str("<main>\n");
    if !material.models.is_empty() {
        html.push_str(include_str!("../assets/calculator.html"));
    }
    section_of_figures(&mut html, figures, folder);
    if material.groups.iter().any(|group| group.planes.is_some()) {
        html.push_str(include_str!("../assets/planes.html"));
    }
    if !material.motions.is_empty() {
        html.push_str(include_str!("../assets/motions.html"));
    }
    tables::section(&mut html, &material.tables);
    section_of_files(&mut html, &material.files);
    html.push_str("</main>\n");
    let _ = writeln!(html, "<script type=\"application/json\" id=\"data\">{}</script>", data::json(material));
    let _ = writeln!(html, "<!-- uPlot:\n{PLOT_LICENSE}-->");
    for script in SCRIPTS {
        let _ = writeln!(html, "<script>\n{script}</script>");
    }
    html.push_str("</body>\n</html>\n");
    html
}

fn header(html: &mut String, material: &Material) {
    html.push_str(
        "<a class=\"skip\" href=\"#figures\">Skip to the figures</a>\n<header>\n<h1>Rocking fragility</h1>\n",
    );
    let responses: usize = material.groups.iter().map(|group| group.responses.len()).sum();
    let mut suites: Vec<&str> = material.groups.iter().filter_map(|group| group.suite.as_deref()).collect();
    suites.sort_unstable();
    suites.dedup();
    let mut structures: Vec<&str> =
        material.groups.iter().map(|group| group.structure.name.as_str()).collect();
    structures.dedup();
    let of_suites =
        if suites.is_empty() { String::new() } else { format!(" to motions of {}", suites.join(", ")) };
    let _ = writeln!(
        html,
        "<p class=\"lead\">{} responses of {}{}</p>",
        number::count(responses),
        escape(&structures.join(", ")),
        escape(&of_suites)
    );
    if material.left_out > 0 {
        let _ = writeln!(
            html,
            "<p>{} further pairs of suite and structure in the file are not shown; --suite and --structure choose others.</p>",
            number::count(material.left_out)
        );
    }
    html.push_str("<nav aria-label=\"Sections\"><ul>");
    let sections = [
        ("calculator", "Calculator", !material.models.is_empty()),
        ("figures", "Figures", true),
        ("planes", "Planes in space", material.groups.iter().any(|group| group.planes.is_some())),
        ("motions", "Motions", !material.motions.is_empty()),
        ("tables", "Tables", !material.tables.is_empty()),
        ("files", "Files", true),
    ];
    for (id, words, _) in sections.into_iter().filter(|(.., there)| *there) {
        let _ = write!(html, "<li><a href=\"#{id}\">{words}</a></li>");
    }
    html.push_str("</ul></nav>\n</header>\n");
}

fn section_of_figures(html: &mut String, figures: &[Figure], folder: &str) {
    html.push_str("<section id=\"figures\"><h2>Figures</h2>\n");
    for (index, figure) in figures.iter().enumerate() {
        let Figure { name, title, caption, drawing } = figure;
        let _ = write!(
            html,
            "<figure id=\"figure-{name}\"><h3>{}. {}</h3>\n<div class=\"picture\" tabindex=\"0\" role=\"group\" aria-label=\"{1}\"><div style=\"--width:{2}\">\n{3}</div></div>\n<figcaption>{4} <span class=\"files\"><a href=\"{folder}/{name}.svg\">SVG</a> <a href=\"{folder}/{name}.png\">PNG</a></span></figcaption></figure>\n",
            index + 1,
            escape(title),
            drawing.width,
            svg(figure, Place::Page),
            escape(caption),
        );
    }
    html.push_str("</section>\n");
}

fn section_of_files(html: &mut String, files: &[File]) {
    html.push_str("<section id=\"files\"><h2>Files</h2>\n<p>What this report was made of. The same seed, options and version give the same files, and these the same report, byte for byte.</p>\n");
    for File { name, stage, version, parameters, content, rows } in files {
        let made = match stage {
            Some(stage) => format!("{stage}, rockfrag {version}"),
            None => "not made by rockfrag".to_string(),
        };
        let _ = write!(
            html,
            "<details><summary><b>{}</b> {}, {} rows</summary><dl>",
            escape(name),
            escape(&made),
            number::count(*rows)
        );
        let _ = write!(html, "<dt>content</dt><dd><code>{}</code></dd>", escape(content));
        if let serde_json::Value::Object(parameters) = parameters {
            for (name, value) in parameters {
                let _ = write!(
                    html,
                    "<dt>{}</dt><dd><code>{}</code></dd>",
                    escape(name),
                    escape(&value.to_string())
                );
            }
        }
        html.push_str("</dl></details>\n");
    }
    html.push_str("</section>\n");
}
