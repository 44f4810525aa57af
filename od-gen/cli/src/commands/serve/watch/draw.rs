//! How the view looks.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

use super::rows::{Row, Scope};
use super::{Keys, View};

/// Names have so many columns at most.
const NAMES: usize = 44;
/// Below this much room for values, names have less.
const VALUES: usize = 24;

const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);
const REVERSED: Style = Style::new().add_modifier(Modifier::REVERSED);

/// Draws everything, on a screen of any size.
pub(super) fn draw(frame: &mut Frame<'_>, view: &mut View<'_>) {
    let [above, middle, below] =
        Layout::vertical([Constraint::Length(1), Constraint::Fill(1), Constraint::Length(1)])
            .areas(frame.area());
    frame.render_widget(Line::styled(view.title.clone(), BOLD), above);
    let height = usize::from(middle.height);
    view.page = height.max(1);
    // Values on several lines may need more room than a page has.
    let last = view.rows.count().saturating_sub(1);
    view.top = if view.top == usize::MAX { (last + 1).saturating_sub(view.page) } else { view.top.min(last) };
    let width = usize::from(middle.width);
    let names = NAMES.min(width.saturating_sub(VALUES).max(width / 2));
    let mut lines = Vec::new();
    for row in view.rows.part(view.top, height) {
        lines.extend(lines_of(row, names, width));
        if lines.len() >= height {
            break;
        }
    }
    frame.render_widget(Paragraph::new(lines), middle);
    frame.render_widget(footer(view), below);
}

/// A row, on as many lines as its value needs.
fn lines_of(row: Row, names: usize, width: usize) -> Vec<Line<'static>> {
    match row {
        Row::Node { name, state, emergency } => {
            let text = match emergency {
                Some(emergency) => format!("{name}  {state}  EMCY {emergency}"),
                None => format!("{name}  {state}"),
            };
            let wrapped = wrapped(&text, width);
            wrapped.into_iter().map(|line| Line::styled(line, BOLD)).collect()
        }
        Row::Entry { name, value } => {
            let room = names.saturating_sub(3);
            let mut short: String = name.chars().take(room).collect();
            if name.chars().count() > room {
                short.pop();
                short.push('…');
            }
            let values = wrapped(&value, width.saturating_sub(names));
            let line = |(at, value): (usize, String)| {
                let name = if at == 0 { short.as_str() } else { "" };
                Line::from(vec![Span::raw(format!("  {name:room$} ")), Span::raw(value)])
            };
            values.into_iter().enumerate().map(line).collect()
        }
    }
}

/// A text in lines of at most so many characters, broken between words where there are some.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let mut lines = vec![String::new()];
    for word in text.split_inclusive(' ') {
        let mut word: Vec<char> = word.chars().collect();
        while !word.is_empty() {
            let used = lines.last().map_or(0, |line| line.chars().count());
            let needed = word.iter().filter(|letter| **letter != ' ').count();
            if used > 0 && used + needed > width {
                lines.push(String::new());
                continue;
            }
            let rest = word.split_off(width.saturating_sub(used).min(word.len()));
            if let Some(line) = lines.last_mut() {
                line.extend(word);
            }
            // Spaces at the end of a line are not at the beginning of the next one.
            word = if rest.iter().all(|letter| *letter == ' ') { Vec::new() } else { rest };
        }
    }
    lines
}

fn footer(view: &View<'_>) -> Line<'static> {
    let filter = &view.rows.filter;
    if view.keys == Keys::Typing {
        return Line::styled(format!("/{filter}▏ Enter keeps, Esc clears"), REVERSED);
    }
    if let Some(note) = &view.note {
        return Line::styled(format!("note: {note}"), REVERSED);
    }
    let hosts = if view.hosts == 1 { "1 host".to_owned() } else { format!("{} hosts", view.hosts) };
    let all = match view.rows.scope() {
        Scope::Moving => "a all entries",
        Scope::All => "a what moves",
    };
    let chosen = if filter.is_empty() { String::new() } else { format!(" ({filter})") };
    let frames = view.frames_per_second;
    Line::styled(format!("{hosts}, {frames} frames/s  q quit  ↑↓ scroll  / filter{chosen}  {all}"), REVERSED)
}
