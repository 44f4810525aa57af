//! Dates and times, in every notation that cannot be misunderstood.

use std::fmt;

use crate::model;

/// A date; printed as the standard has it, `mm-dd-yyyy`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Date(model::Date);

/// A time; printed as the standard has it, `hh:mmAM`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Time {
    /// 0 to 23.
    hour: u8,
    minute: u8,
}

const MONTHS: [&str; 12] =
    ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];

impl Date {
    /// Reads a date whose order is certain: that of the standard, `mm-dd-yyyy`, with the year in front, with the name of a
    /// month, or with a day above 12.
    pub(super) fn read(text: &str) -> Option<Self> {
        let separator = ['-', '/', '.'].into_iter().find(|sign| text.contains(*sign))?;
        let mut parts = text.split(separator).map(str::trim);
        let (first, second, third) = (parts.next()?, parts.next()?, parts.next()?);
        if parts.next().is_some() {
            return None;
        }
        if first.len() == 4 {
            return Self::new(number(first)?, number(second)?, number(third)?);
        }
        let year = number(third).filter(|_| third.len() == 4)?;
        if let Some(month) = month(second) {
            return Self::new(year, month, number(first)?);
        }
        let (one, two) = (number(first)?, number(second)?);
        match (one, two) {
            (13.., _) => Self::new(year, two, one),
            (_, 13..) => Self::new(year, one, two),
            // With dashes it is the order of the standard; with anything else nobody knows.
            _ if separator == '-' || one == two => Self::new(year, one, two),
            _ => None,
        }
    }

    fn new(year: u16, month: u16, day: u16) -> Option<Self> {
        model::Date::of(year, month, day).filter(|date| date.year >= 1000).map(Self)
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:02}-{:02}-{}", self.0.month, self.0.day, self.0.year)
    }
}

impl Time {
    /// Reads a time of 12 hours with AM or PM, or of 24 hours without; seconds are left out, as the standard has none.
    pub(super) fn read(text: &str) -> Option<Self> {
        let upper = text.to_ascii_uppercase();
        let half =
            ["AM", "PM"].into_iter().find_map(|half| Some((upper.strip_suffix(half)?.trim_end(), half)));
        let mut parts = half.map_or(upper.as_str(), |(digits, _)| digits).split(':');
        let (hour, minute) = (number(parts.next()?)?, number(parts.next()?).filter(|minute| *minute < 60)?);
        let has_seconds =
            parts.next().is_none_or(|seconds| number(seconds).is_some_and(|seconds| seconds < 60));
        if !has_seconds || parts.next().is_some() {
            return None;
        }
        let hour = match (half, hour) {
            (None, 0..=23) => hour,
            (Some((_, "AM")), 0..=11) => hour,
            (Some((_, "AM")), 12) => 0,
            (Some((_, "PM")), 1..=11) => hour + 12,
            // A time of 24 hours that says once more that it is after noon.
            (Some((_, "PM")), 12..=23) => hour,
            _ => return None,
        };
        Some(Self { hour: u8::try_from(hour).ok()?, minute: u8::try_from(minute).ok()? })
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let half = if self.hour < 12 { "AM" } else { "PM" };
        let hour = match self.hour % 12 {
            0 => 12,
            hour => hour,
        };
        write!(f, "{hour:02}:{:02}{half}", self.minute)
    }
}

/// One to four digits.
fn number(text: &str) -> Option<u16> {
    let is_number = (1..=4).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_digit());
    text.parse().ok().filter(|_| is_number)
}

/// An English name of a month, or its first three letters.
fn month(name: &str) -> Option<u16> {
    let is_word = name.len() >= 3 && name.bytes().all(|byte| byte.is_ascii_alphabetic());
    let short = name.get(..3).filter(|_| is_word)?.to_ascii_lowercase();
    let at = MONTHS.iter().position(|month| *month == short)?;
    u16::try_from(at + 1).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_read_where_they_are_certain() {
        for (text, date) in [
            ("02-07-2016", "02-07-2016"),
            ("2016-02-07", "02-07-2016"),
            ("07-Feb-2016", "02-07-2016"),
            ("17/07/2024", "07-17-2024"),
            ("15-02-2019", "02-15-2019"),
            ("04-4-2018", "04-04-2018"),
            ("02-29-2020", "02-29-2020"),
            ("12/31/1999", "12-31-1999"),
        ] {
            assert_eq!(Date::read(text).map(|date| date.to_string()).as_deref(), Some(date), "{text}");
        }
        for text in [
            "",
            "01-08-26",
            "02/03/2020",
            "02.03.2020",
            "02-30-2020",
            "13-13-2020",
            "x-y-z",
            "2020",
            "02-29-2021",
        ] {
            assert_eq!(Date::read(text), None, "{text}");
        }
    }

    #[test]
    fn times_are_read_where_they_are_certain() {
        for (text, time) in [
            ("09:45AM", "09:45AM"),
            ("12:00AM", "12:00AM"),
            ("12:30PM", "12:30PM"),
            ("9:45am", "09:45AM"),
            ("08:55 PM", "08:55PM"),
            ("13:51", "01:51PM"),
            ("00:07", "12:07AM"),
            ("12:05:34", "12:05PM"),
            ("17:27PM", "05:27PM"),
            ("00:30AM", "12:30AM"),
        ] {
            assert_eq!(Time::read(text).map(|time| time.to_string()).as_deref(), Some(time), "{text}");
        }
        for text in ["", "17:27AM", "00:30PM", "24:00", "12:60", "12", "1:2:3:4", "ab:cd"] {
            assert_eq!(Time::read(text), None, "{text}");
        }
    }
}
