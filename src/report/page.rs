//! One HTML page that needs nothing else: style, fonts, scripts, figures and data stand in it.

use std::fmt::Write;

use base64::prelude::{BASE64_STANDARD, Engine};

use super::data::{File, ReportData, Table};
use super::figure::Figure;
use super::font::Face;
use super::page_data;
use super::svg::{Place, svg};
use super::text::{escape, number};

const STYLE: &str = include_str!("assets/page.css");
const PLOT_STYLE: &str = include_str!("assets/uPlot.min.css");
const PLOT_LICENSE: &str = include_str!("assets/uPlot.LICENSE");
const SCRIPTS: [&str; 7] = [
    include_str!("assets/uPlot.iife.min.js"),
    include_str!("assets/normal.js"),
    include_str!("assets/fragility.js"),
    include_str!("assets/universal.js"),
    include_str!("assets/calculator.js"),
    include_str!("assets/planes.js"),
    include_str!("assets/motions.js"),
];

/// What a page holds besides the data of the report.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    pub figures: &'a [Figure],
    /// Folder of the figures' files, as a link from the page.
    pub folder: &'a str,
    /// Provenance as a JSON object: tells whether the page is up to date.
    pub provenance: &'a str,
}

/// Writes the page.
pub fn page(data: &ReportData, Page { figures, folder, provenance }: Page) -> String {
    let mut html = String::with_capacity(1 << 20);
    html.push_str("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    // Read back by the stage: it must stay near the start.
    let _ = writeln!(html, "<meta name=\"rockfrag\" content=\"{}\">", escape(provenance));
    html.push_str("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    html.push_str(
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Rocking fragility report</title>\n",
    );
    html.push_str("<link rel=\"icon\" href=\"data:,\">\n<style>\n");
    for (face, style) in Face::ALL.into_iter().zip(["400", "400;font-style:italic", "600"]) {
        let _ = writeln!(
            html,
            "@font-face{{font-family:\"Fira Sans\";font-weight:{style};src:url(data:font/ttf;base64,{})}}",
            BASE64_STANDARD.encode(face.file())
        );
    }
    html.push_str(PLOT_STYLE);
    html.push_str(STYLE);
    html.push_str("</style>\n</head>\n<body>\n");
    header(&mut html, data);
    html.push_str("<main>\n");
    if !data.models.is_empty() {
        html.push_str(include_str!("assets/calculator.html"));
    }
    section_of_figures(&mut html, figures, folder);
    if data.groups.iter().any(|group| group.planes.is_some()) {
        html.push_str(include_str!("assets/planes.html"));
    }
    if !data.motions.is_empty() {
        html.push_str(include_str!("assets/motions.html"));
    }
    section_of_tables(&mut html, &data.tables);
    section_of_files(&mut html, &data.files);
    html.push_str("</main>\n");
    let _ =
        writeln!(html, "<script type=\"application/json\" id=\"data\">{}</script>", page_data::json(data));
    let _ = writeln!(html, "<!-- uPlot:\n{PLOT_LICENSE}-->");
    for script in SCRIPTS {
        let _ = writeln!(html, "<script>\n{script}</script>");
    }
    html.push_str("</body>\n</html>\n");
    html
}

fn header(html: &mut String, data: &ReportData) {
    html.push_str(
        "<a class=\"skip\" href=\"#figures\">Skip to the figures</a>\n<header>\n<h1>Rocking fragility</h1>\n",
    );
    let responses: usize = data.groups.iter().map(|group| group.responses.len()).sum();
    let mut suites: Vec<&str> = data.groups.iter().filter_map(|group| group.suite.as_deref()).collect();
    suites.sort_unstable();
    suites.dedup();
    let mut structures: Vec<&str> = data.groups.iter().map(|group| group.structure.name.as_str()).collect();
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
    if data.left_out > 0 {
        let _ = writeln!(
            html,
            "<p>{} further pairs of suite and structure in the file are not shown; --suite and --structure choose others.</p>",
            number::count(data.left_out)
        );
    }
    html.push_str("<nav aria-label=\"Sections\"><ul>");
    let sections = [
        ("calculator", "Calculator", !data.models.is_empty()),
        ("figures", "Figures", true),
        ("planes", "Planes in space", data.groups.iter().any(|group| group.planes.is_some())),
        ("motions", "Motions", !data.motions.is_empty()),
        ("tables", "Tables", !data.tables.is_empty()),
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

fn section_of_tables(html: &mut String, tables: &[Table]) {
    if tables.is_empty() {
        return;
    }
    html.push_str("<section id=\"tables\"><h2>Tables</h2>\n");
    for table in tables {
        write_table(html, table);
    }
    html.push_str("</section>\n");
}

fn write_table(html: &mut String, Table { title, columns, rows, left_out }: &Table) {
    let title = escape(title);
    let _ = write!(
        html,
        "<h3>{title}</h3>\n<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"{title}\"><table><thead><tr>"
    );
    let class = |numeric: bool| if numeric { " class=\"number\"" } else { "" };
    for column in columns {
        let (name, description) = (escape(&column.name), escape(&column.description));
        let _ =
            write!(html, "<th scope=\"col\" title=\"{description}\"{}>{name}</th>", class(column.numeric));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (cell, column) in row.iter().zip(columns) {
            let _ = write!(html, "<td{}>{}</td>", class(column.numeric), escape(cell));
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
    if *left_out > 0 {
        let _ = writeln!(html, "<p>{} further rows are in the file.</p>", number::count(*left_out));
    }
}
