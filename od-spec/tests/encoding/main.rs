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
            .filter_map(|(word, bytes)| {
                let (read, found) = decode(bytes).ok()?;
                (read != word).then(|| format!("{word} in {page} is read as {read} in {found}"))
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

#[test]
fn a_code_page_with_two_bytes_a_character_is_named() {
    // "temperature", "speed", "actual position" as they are stored on Chinese and Japanese systems.
    let gbk: [&[u8]; 2] = [
        b"[2000]\nParameterName=\xCE\xC2\xB6\xC8\n",
        b"a=\xCB\xD9\xB6\xC8\nb=\xCA\xB5\xBC\xCA\xCE\xBB\xD6\xC3\n",
    ];
    for bytes in gbk {
        assert_eq!(decode(bytes.to_vec()), Err(Unread::Gbk));
    }
    let shift_jis: [&[u8]; 2] =
        [b"[2000]\nParameterName=\x89\xB7\x93x\n", b"a=\x91\xAC\x93x\nb=\x8C\xBB\x8D\xDD\x88\xCA\x92u\n"];
    for bytes in shift_jis {
        assert_eq!(decode(bytes.to_vec()), Err(Unread::ShiftJis));
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
