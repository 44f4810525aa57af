//! The work that a file makes grows with its size, whatever is in it many times. The bytes that are asked for count it: they are the
//! same in every run.

use od_import::import;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, Strictness, add_source, compile_as, fix};

/// Makes a file.
type Pattern = fn(usize) -> String;
/// Does something with one.
type Step = fn(&[u8]);

/// Files with something in them so many times.
const PATTERNS: [(&str, Pattern); 16] = [
    ("sections of one name", |n| object(0x2000).repeat(n)),
    ("empty sections", |n| numbered(n, |at| format!("[{:X}]\n", 0x2000 + at))),
    ("objects", |n| (0..n).map(|at| object(0x2000 + at)).collect()),
    ("unknown sections", |n| "[something]\na=1\n".repeat(n)),
    ("keys with a slip", |n| object(0x2000) + &numbered(n, |at| format!("ParametrName{at}=1\n"))),
    ("information with a slip", |n| {
        "[DeviceInfo]\n".to_owned() + &numbered(n, |at| format!("Vendrname{at}=1\n"))
    }),
    ("one key", |n| object(0x2000) + &numbered(n, |at| format!("DefaultValue={at}\n"))),
    ("one key with a space", |n| object(0x2000) + &"Default Value=1\n".repeat(n)),
    ("keys with a space", |n| object(0x2000) + &numbered(n, |at| format!("a b{at}=1\n"))),
    ("lines that cannot be read", |n| "nothing\n".repeat(n)),
    ("a list of one object", |n| {
        "[OptionalObjects]\n".to_owned() + &numbered(n, |at| format!("{at}=0x2000\n"))
    }),
    ("modules", |n| {
        numbered(n, |at| {
            format!("[M{at}ModuleInfo]\nProductName=m\n[M{at}SubExtends]\nNrOfEntries=1\n1=0x6000\n")
        })
    }),
    ("a long name", |n| format!("[2000]\nParameterName={}\nDataType=5\nAccessType=ro\n", "x".repeat(20 * n))),
    ("a long foreign text", |n| format!("[FileInfo]\nDescription={}\n", "ä".repeat(20 * n))),
    ("a long number", |n| format!("{}DefaultValue={}\n", object(0x2000), "9".repeat(20 * n))),
    ("comments", |n| "; 5: five\n".repeat(n) + &object(0x2000)),
];

fn object(index: usize) -> String {
    format!(
        "[{index:X}]\nParameterName=object {index}\nObjectType=7\nDataType=5\nAccessType=rw\nPDOMapping=0\n"
    )
}

fn numbered(count: usize, line: fn(usize) -> String) -> String {
    (1..=count).map(line).collect()
}

fn check(bytes: &[u8]) {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, "a.eds", bytes.to_vec()).unwrap();
    compile_as(Strictness::Standard, &mut sources, root, &mut NoFiles);
}

fn turn(bytes: &[u8]) {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, "a.eds", bytes.to_vec()).unwrap();
    let compiled = compile_as(Strictness::Foreign, &mut sources, root, &mut NoFiles);
    let _ = import(&compiled, &sources, root);
}

fn put_right(bytes: &[u8]) {
    drop(fix("a.eds", bytes));
}

#[test]
fn twice_as_much_is_twice_the_work() {
    const STEPS: [(&str, Step); 3] = [("check", check), ("fix", put_right), ("import", turn)];
    let mut wrong = Vec::new();
    for (step, run) in STEPS {
        // What is made once for all files.
        run(object(0x2000).as_bytes());
        for (pattern, make) in PATTERNS {
            let [one, two, four] = [200, 400, 800].map(|count| {
                // What has no section is refused as a whole.
                let text = make(count) + "[Comments]\n";
                let used = super::meter(&mut || run(text.as_bytes()));
                used.total
            });
            // Lists and maps grow in leaps: a third and a little is for them.
            if (four - two) * 10 > (two - one) * 27 + 2_000_000 {
                wrong.push(format!("{step} of {pattern}: {one}, {two}, {four} bytes"));
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}
