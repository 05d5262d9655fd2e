//! One HTML page that needs nothing else: style, fonts, scripts, figures and data stand in it.

use std::fmt::Write;

use base64::prelude::{BASE64_STANDARD, Engine};

use super::data::{By, File, ReportData, Table};
use super::drawing::TWO_COLUMNS;
use super::figure::Figure;
use super::figures::Part;
use super::findings::findings;
use super::font::Face;
use super::page_data;
use super::svg::{Place, svg};
use super::text::{escape, number};

const STYLE: &str = include_str!("assets/page.css");
const PLOT_STYLE: &str = include_str!("assets/uPlot.min.css");
const PLOT_LICENSE: &str = include_str!("assets/uPlot.LICENSE");
const SCRIPTS: [&str; 8] = [
    include_str!("assets/uPlot.iife.min.js"),
    include_str!("assets/normal.js"),
    include_str!("assets/fragility.js"),
    include_str!("assets/universal.js"),
    include_str!("assets/calculator.js"),
    include_str!("assets/planes.js"),
    include_str!("assets/motions.js"),
    include_str!("assets/figures.js"),
];

/// What the page is called unless the user says so.
const TITLE: &str = "Rocking fragility";

/// A part of the page that holds figures.
struct PartOfPage {
    part: Part,
    id: &'static str,
    words: &'static str,
    /// Whether it is on paper, too.
    is_printed: bool,
    is_folded: bool,
}

const PARTS: [PartOfPage; 5] = [
    of_page(Part::Curves, "curves", "Fragility curves", [true, false]),
    of_page(Part::Site, "site", "At the site", [true, false]),
    of_page(Part::Checks, "checks", "Checks", [true, false]),
    of_page(Part::Responses, "responses", "Motions and responses", [false, false]),
    of_page(Part::Background, "background", "Regressions and further curves", [false, true]),
];

const fn of_page(
    part: Part,
    id: &'static str,
    words: &'static str,
    [is_printed, is_folded]: [bool; 2],
) -> PartOfPage {
    PartOfPage { part, id, words, is_printed, is_folded }
}

/// What a page holds besides the data of the report.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    pub figures: &'a [(Part, Figure)],
    /// Folder of the figures' files, as a link from the page.
    pub folder: &'a str,
    /// Provenance as a JSON object: tells whether the page is up to date.
    pub provenance: &'a str,
}

/// Writes the page.
pub fn page(data: &ReportData, Page { figures, folder, provenance }: Page) -> String {
    let given = data.title.as_deref().filter(|title| !title.trim().is_empty());
    let title = escape(given.unwrap_or(TITLE));
    let mut html = String::with_capacity(1 << 20);
    html.push_str("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    // Read back by the stage: it must stay near the start.
    let _ = writeln!(html, "<meta name=\"rockfrag\" content=\"{}\">", escape(provenance));
    html.push_str("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    let _ = writeln!(html, "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>");
    if let Some(author) = &data.author {
        let _ = writeln!(html, "<meta name=\"author\" content=\"{}\">", escape(author));
    }
    html.push_str("<link rel=\"icon\" href=\"data:,\">\n<style id=\"fonts\">\n");
    for (face, style) in Face::ALL.into_iter().zip(["400", "400;font-style:italic", "600"]) {
        let _ = writeln!(
            html,
            "@font-face{{font-family:\"Fira Sans\";font-weight:{style};src:url(data:font/ttf;base64,{})}}",
            BASE64_STANDARD.encode(face.file())
        );
    }
    html.push_str("</style>\n<style>\n");
    html.push_str(PLOT_STYLE);
    html.push_str(STYLE);
    html.push_str("</style>\n</head>\n<body>\n");
    header(&mut html, data, &title, figures);
    html.push_str("<main>\n");
    findings(&mut html, data);
    for (number, group) in PARTS.iter().enumerate() {
        section_of_figures(&mut html, group, figures, folder);
        if number == 0 && !data.models.is_empty() {
            html.push_str(include_str!("assets/calculator.html"));
        }
    }
    if data.groups.iter().any(|group| group.planes.is_some()) {
        html.push_str(include_str!("assets/planes.html"));
    }
    if !data.motions.is_empty() {
        html.push_str(include_str!("assets/motions.html"));
    }
    section_of_tables(&mut html, &data.tables);
    let surface = if data.has_rates_by(By::Surface) { include_str!("assets/surface.html") } else { "" };
    let method = include_str!("assets/method.html").replace("{version}", env!("CARGO_PKG_VERSION"));
    html.push_str(&method.replace("{surface}", surface));
    section_of_files(&mut html, &data.files);
    html.push_str("</main>\n");
    let drawn: Vec<&Figure> = figures.iter().map(|(_, figure)| figure).collect();
    let _ = writeln!(
        html,
        "<script type=\"application/json\" id=\"data\">{}</script>",
        page_data::json(data, &drawn)
    );
    let _ = writeln!(html, "<!-- uPlot:\n{PLOT_LICENSE}-->");
    for script in SCRIPTS {
        let _ = writeln!(html, "<script>\n{script}</script>");
    }
    html.push_str("</body>\n</html>\n");
    html
}

fn header(html: &mut String, data: &ReportData, title: &str, figures: &[(Part, Figure)]) {
    let _ = writeln!(
        html,
        "<a class=\"skip\" href=\"#findings\">Skip to the findings</a>\n<header>\n<h1>{title}</h1>"
    );
    let by: Vec<String> =
        [&data.author, &data.date].into_iter().flatten().map(|words| escape(words)).collect();
    if !by.is_empty() {
        let _ = writeln!(html, "<p class=\"lead\">{}</p>", by.join(" · "));
    }
    html.push_str("<nav aria-label=\"Sections\"><ul><li><a href=\"#findings\">Findings</a></li>");
    let mut link = |id: &str, words: &str, there: bool| {
        if there {
            let _ = write!(html, "<li><a href=\"#{id}\">{words}</a></li>");
        }
    };
    for (number, PartOfPage { part, id, words, .. }) in PARTS.iter().enumerate() {
        link(id, words, figures.iter().any(|(other, _)| other == part));
        if number == 0 {
            link("calculator", "Calculator", !data.models.is_empty());
        }
    }
    link("planes", "Planes in space", data.groups.iter().any(|group| group.planes.is_some()));
    link("motions", "Motions", !data.motions.is_empty());
    link("tables", "Tables", !data.tables.is_empty());
    link("method", "Method", true);
    link("files", "Files", true);
    html.push_str("</ul></nav>\n</header>\n");
}

fn section_of_figures(html: &mut String, of: &PartOfPage, figures: &[(Part, Figure)], folder: &str) {
    let PartOfPage { part, id, words, is_printed, is_folded } = of;
    let own = || (1..).zip(figures).filter(|(_, (other, _))| other == part);
    if own().next().is_none() {
        return;
    }
    let class = if *is_printed { "" } else { " class=\"screen\"" };
    let _ = writeln!(html, "<section id=\"{id}\"{class}><h2>{words}</h2>");
    if *is_folded {
        let _ = writeln!(html, "<details><summary>Show {} figures</summary>", own().count());
    }
    for (number, (_, figure)) in own() {
        write_figure(html, number, figure, folder);
    }
    if *is_folded {
        html.push_str("</details>\n");
    }
    html.push_str("</section>\n");
}

fn write_figure(html: &mut String, number: usize, figure: &Figure, folder: &str) {
    let Figure { name, title, caption, drawing, .. } = figure;
    let title = escape(title);
    let class = if drawing.width < TWO_COLUMNS { " class=\"column\"" } else { "" };
    let _ = write!(
        html,
        "<figure id=\"figure-{name}\"{class}><h3>{number}. {title}</h3>\n<div class=\"picture scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{title}\"><div style=\"--width:{}\">\n{}</div></div>\n<figcaption>{} <span class=\"files\">",
        drawing.width,
        svg(figure, Place::Page),
        escape(caption),
    );
    for kind in ["svg", "png", "csv"] {
        let _ = write!(
            html,
            "<a href=\"{folder}/{name}.{kind}\" download=\"{name}.{kind}\">{}</a> ",
            kind.to_uppercase()
        );
    }
    html.push_str("</span></figcaption></figure>\n");
}

fn section_of_files(html: &mut String, files: &[File]) {
    html.push_str("<section id=\"files\" class=\"screen\"><h2>Files</h2>\n<p>What this report was made of. The same seed, options and version give the same files, and these the same report, byte for byte.</p>\n");
    for File { name, stage, version, parameters, content, rows, .. } in files {
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
    html.push_str("<section id=\"tables\" class=\"screen\"><h2>Tables</h2>\n");
    for table in tables {
        write_table(html, table);
    }
    html.push_str("</section>\n");
}

fn write_table(html: &mut String, Table { name, title, columns, rows, left_out, csv }: &Table) {
    let title = escape(title);
    let _ = write!(
        html,
        "<details><summary>{title}, {} rows</summary>\n<p class=\"files\"><a download=\"{name}.csv\" href=\"data:text/csv;base64,{}\">CSV</a></p><div class=\"table scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{title}\"><table><thead><tr>",
        number::count(rows.len() + left_out),
        BASE64_STANDARD.encode(csv)
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
    html.push_str("</details>\n");
}
