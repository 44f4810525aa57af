//! The pictures of the README: a page and a message, drawn from what the example gives.

use std::fmt::Write as _;

use crate::Failure;

/// An object and a PDO of a device's HTML page, with its style sheet, as a picture.
///
/// # Errors
/// The page lacks one of them.
pub(crate) fn page(html: &str) -> Result<String, Failure> {
    let between = |from: &str, to: &str| {
        let start = html.find(from).ok_or_else(|| format!("the page lacks `{from}`"))?;
        let rest = html.get(start..).unwrap_or_default();
        let end = rest.find(to).ok_or_else(|| format!("the page lacks `{to}` after `{from}`"))?;
        Ok::<_, Failure>(rest.get(..end + to.len()).unwrap_or_default())
    };
    let style = between("<style>", "</style>")?.replace("<style>", "").replace("</style>", "");
    let parts = [
        between("<article class=\"object\" id=\"2000\"", "</article>")?,
        between("<section class=\"part pdo\" id=\"rpdo-1\">", "</svg>")?,
        // What scrolls the picture of the PDO.
        "</div></section>",
    ];
    // Here they are XML, where an element inside another one has its namespace.
    let body = parts.join("\n").replace("<svg ", "<svg xmlns=\"http://www.w3.org/2000/svg\" ");
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"960\" height=\"350\" viewBox=\"0 0 960 350\" \
         role=\"img\" aria-label=\"An object and a PDO on the page of the valve\">\n\
         <style><![CDATA[{style}*{{content-visibility:visible!important}}]]></style>\n\
         <foreignObject width=\"100%\" height=\"100%\">\n\
         <div xmlns=\"http://www.w3.org/1999/xhtml\" style=\"height:100%;padding:.1rem 1rem;background:var(--back);\
         color:var(--text);font:15px/1.5 system-ui,'Segoe UI','DejaVu Sans',sans-serif\">\n\
         {body}\n</div>\n</foreignObject>\n</svg>\n"
    ))
}

/// Lines of a terminal as a picture.
pub(crate) fn screen(text: &str) -> String {
    /// Pixels of a character and of a line.
    const WIDTH: usize = 8;
    const HEIGHT: usize = 19;
    let lines: Vec<&str> = text.trim_end().lines().collect();
    let width = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0) * WIDTH + 32;
    let height = lines.len() * HEIGHT + 28;
    let mut picture = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"A message\">\n\
         <style>text{{font:13px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;white-space:pre;\
         fill:#e6e9ec}}.error{{fill:#ff8080;font-weight:bold}}.help{{fill:#7cb7ff}}</style>\n\
         <rect width=\"100%\" height=\"100%\" rx=\"6\" fill=\"#14181d\"/>\n"
    );
    for (row, line) in lines.iter().enumerate() {
        let class = match line {
            line if line.starts_with("error") || line.contains("^^") => " class=\"error\"",
            line if line.starts_with("help") => " class=\"help\"",
            _ => "",
        };
        let (y, length) = (row * HEIGHT + 27, line.chars().count() * WIDTH);
        let line = line.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        // Whatever font there is, columns stay below each other.
        let _ = writeln!(
            picture,
            "<text{class} x=\"16\" y=\"{y}\" textLength=\"{length}\" xml:space=\"preserve\">{line}</text>"
        );
    }
    picture + "</svg>\n"
}
