//! Files that do not say how their characters are stored are read in the code page in which they make words.

use od_spec::encoding::{Encoding, Unread, as_likely, decode, encode};

/// The words of the list that a code page has, without those of other alphabets.
fn words(page: Encoding) -> Vec<(String, Vec<u8>)> {
    let lines = include_str!("words.txt").lines().filter(|line| !line.starts_with('#'));
    let words = lines.flat_map(str::split_whitespace).map(|word| word.replace('_', " "));
    let stored = words.filter(|word| !word.is_ascii()).filter_map(|word| {
        let bytes = encode(&word, page).ok()?;
        Some((word, bytes))
    });
    stored.collect()
}

#[test]
fn each_word_alone_shows_its_code_page() {
    for page in [Encoding::Windows1252, Encoding::Cp850] {
        let words = words(page);
        assert!(words.len() > 400, "{} words in {page}", words.len());
        let wrong: Vec<String> = words
            .into_iter()
            .filter_map(|(word, bytes)| match decode(bytes) {
                Ok((read, _)) if read == word => None,
                Ok((read, found)) => Some(format!("{word} in {page} is read as {read} in {found}")),
                Err(unread) => Some(format!("{word} in {page} is taken as {}", unread.name())),
            })
            .collect();
        assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    }
}

#[test]
fn all_words_together_show_their_code_page() {
    for page in [Encoding::Windows1252, Encoding::Cp850] {
        let (texts, stored): (Vec<String>, Vec<Vec<u8>>) = words(page).into_iter().unzip();
        assert_eq!(decode(stored.join(&b'\n')), Ok((texts.join("\n"), page)));
    }
}

#[test]
fn where_as_much_speaks_for_both_it_is_windows_1252_and_the_other_is_named() {
    // Öndice or Índice.
    let (text, page) = decode(b"\xD6ndice".to_vec()).unwrap();
    assert_eq!((text.as_str(), page), ("Öndice", Encoding::Windows1252));
    assert_eq!(as_likely(&text, page), Some(Encoding::Cp850));
    let (text, page) = decode(b"f\xFCr".to_vec()).unwrap();
    assert_eq!((text.as_str(), page, as_likely(&text, page)), ("für", Encoding::Windows1252, None));
    assert_eq!(as_likely("für", Encoding::Utf8), None);
}

#[test]
fn russian_words_are_read() {
    for words in ["Скорость двигателя", "температура", "Напряжение питания, В", "Счётчик ошибок"]
    {
        let bytes = encode(words, Encoding::Windows1251).unwrap();
        assert_eq!(decode(bytes), Ok((words.to_owned(), Encoding::Windows1251)));
    }
}

/// Names of objects as Chinese systems store them: temperature, speed, actual position, motor speed, and so on.
const GBK: [&[u8]; 12] = [
    b"\xCE\xC2\xB6\xC8",
    b"\xCB\xD9\xB6\xC8",
    b"\xCA\xB5\xBC\xCA\xCE\xBB\xD6\xC3",
    b"\xB5\xE7\xBB\xFA\xD7\xAA\xCB\xD9",
    b"\xC4\xB8\xCF\xDF\xB5\xE7\xD1\xB9",
    b"\xB9\xCA\xD5\xCF\xB4\xFA\xC2\xEB",
    b"\xBC\xD3\xCB\xD9\xB6\xC8",
    b"\xBF\xD8\xD6\xC6\xD7\xD6",
    b"\xD7\xB4\xCC\xAC\xD7\xD6",
    b"\xB6\xEE\xB6\xA8\xB5\xE7\xC1\xF7",
    b"\xB3\xA7\xC9\xCC",
    b"\xC9\xE8\xB1\xB8\xC0\xE0\xD0\xCD",
];
/// The same as Japanese systems store them.
const SHIFT_JIS: [&[u8]; 11] = [
    b"\x89\xB7\x93\x78",
    b"\x91\xAC\x93\x78",
    b"\x8C\xBB\x8D\xDD\x88\xCA\x92\x75",
    b"\x83\x82\x81\x5B\x83\x5E\x91\xAC\x93\x78",
    b"\x93\x64\x88\xB3",
    b"\x83\x47\x83\x89\x81\x5B",
    b"\x89\xC1\x91\xAC\x93\x78",
    b"\x90\xA7\x8C\xE4",
    b"\x8F\xF3\x91\xD4",
    b"\x92\xE8\x8A\x69\x93\x64\x97\xAC",
    b"\x83\x67\x83\x8B\x83\x4E",
];

#[test]
fn a_code_page_with_two_bytes_a_character_is_named() {
    for (names, page) in [(&GBK[..], Unread::Gbk), (&SHIFT_JIS, Unread::ShiftJis)] {
        for name in names {
            let text = [b"[2000]\nParameterName=", *name, b"\nDataType=5\n"].concat();
            assert_eq!(decode(text), Err(page), "{name:?}");
        }
        let all = names.iter().flat_map(|name| [b"\nParameterName=", *name].concat()).collect();
        assert_eq!(decode(all), Err(page));
    }
}

#[test]
fn utf16_without_a_mark_is_recognised() {
    let text = "[2000]\r\nParameterName=温度\r\n";
    for encoding in [Encoding::Utf16LeUnmarked, Encoding::Utf16BeUnmarked] {
        let bytes = encode(text, encoding).unwrap();
        assert_eq!(decode(bytes), Ok((text.to_owned(), encoding)));
    }
}
