//! Fixed sentences of comments, in every language. Words for facts are those of `od_spec::wording`.

use od_spec::wording::Language;

macro_rules! phrases {
    ($($(#[$meta:meta])* $variant:ident: $english:literal, $german:literal;)+) => {
        /// A fixed sentence. `{}` stands for what differs.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(super) enum Phrase { $($(#[$meta])* $variant,)+ }

        impl Phrase {
            const fn text(self, language: Language) -> &'static str {
                match (self, language) {
                    $((Phrase::$variant, Language::English) => $english,
                    (Phrase::$variant, Language::German) => $german,)+
                }
            }
        }
    };
}

phrases! {
    /// At the top of the file of constants.
    ConstantsFile:
        "{}: constants. Index, sub-index, length in bytes and data type of each entry (for SDO blocks), default and limits as raw values, special values; values of enums; masks of bits; states, commands and error codes; PDOs.",
        "{}: Konstanten. Index, Subindex, Länge in Bytes und Datentyp jedes Eintrags (für SDO-Bausteine), Vorgabe und Grenzen als Rohwerte, besondere Werte; Werte der Aufzählungen; Masken der Bits; Zustände, Befehle und Fehlercodes; PDOs.";
    /// At the top of the file of enums.
    EnumsFile:
        "{}: enums, for CODESYS V3 and TwinCAT 3. Nothing in the other files needs them.",
        "{}: Aufzählungen, für CODESYS V3 und TwinCAT 3. Nichts in den anderen Dateien braucht sie.";
    /// At the top of the file of code.
    CodeFile:
        "{}: structures, functions and function blocks. They need no constants and no library.",
        "{}: Strukturen, Funktionen und Funktionsbausteine. Sie brauchen weder Konstanten noch eine Bibliothek.";
    /// Behind the head of each file.
    Encoding:
        "UTF-8. Everything but comments is ASCII.",
        "UTF-8. Alles außer den Kommentaren ist ASCII.";
    /// The node of the file.
    OfNode: "For the node-ID {}.", "Für die Node-ID {}.";
    /// Special value.
    Special: "special value: {}", "besonderer Wert: {}";
    /// Error codes.
    ErrorCodes: "Error codes (EMCY, 603Fh, 1003h)", "Fehlercodes (EMCY, 603Fh, 1003h)";
    /// Values of an enum.
    ValuesOf: "Values of {}", "Werte von {}";
    /// A value that only a standard defines.
    Unsupported: "not supported by this device", "wird von diesem Gerät nicht unterstützt";
    /// Bits of a type.
    BitsOf: "Bits of {}", "Bits von {}";
    /// A bit that is active at 0.
    ActiveLow: "active at 0", "aktiv bei 0";
    /// A bit that acts when it rises.
    RisingEdge: "acts when it changes from 0 to 1", "wirkt beim Wechsel von 0 nach 1";
    /// A bit that acts when it falls.
    FallingEdge: "acts when it changes from 1 to 0", "wirkt beim Wechsel von 1 nach 0";
    /// A bit that acts at each change.
    BothEdges: "acts when it changes", "wirkt bei jedem Wechsel";
    /// What bits mean in a mode.
    InMode: "in mode {}: {}", "in Betriebsart {}: {}";
    /// Multiples of the lowest bit of a run.
    Shift: "lowest bit of the run", "niedrigstes Bit der Folge";
    /// Function that tells bits apart.
    UnpackBits: "Tells the bits of {} apart.", "Zerlegt {} in seine Bits.";
    /// Function that puts bits together.
    PackBits:
        "Puts the bits of {} together; reserved bits are 0. FALSE: a run of bits has a number that is too large, and the word stays as it was.",
        "Setzt die Bits von {} zusammen; reservierte Bits sind 0. FALSE: eine Folge von Bits hat eine zu große Zahl, und das Wort bleibt, wie es war.";
    /// States of a machine.
    StatesOf: "States of {}, as {} shows them: word AND mask = value", "Zustände von {}, wie {} sie zeigt: Wort AND Maske = Wert";
    /// No state.
    NoState: "no state: the bits show none", "kein Zustand: die Bits zeigen keinen";
    /// Function that tells the state.
    StateFunction: "The state of {} that the bits of {} show; 0 where they show none.", "Der Zustand von {}, den die Bits von {} zeigen; 0, wo sie keinen zeigen.";
    /// Commands of a machine.
    CommandsOf: "Commands of {}, in {}", "Befehle von {}, in {}";
    /// Function that gives a command.
    CommandFunction:
        "The word with the bits of a command of {}; the other bits stay. Another number than that of a command changes nothing.",
        "Das Wort mit den Bits eines Befehls von {}; die übrigen Bits bleiben. Eine andere Zahl als die eines Befehls ändert nichts.";
    /// Bits that have to rise.
    Rising: "bits that have to change from 0 to 1: send a word without them before", "Bits, die von 0 nach 1 wechseln müssen: vorher ein Wort ohne sie senden";
    /// Bits that have to fall.
    Falling: "bits that have to change from 1 to 0: send a word with them before", "Bits, die von 1 nach 0 wechseln müssen: vorher ein Wort mit ihnen senden";
    /// A value that gives a command.
    Send: "a value that gives the command", "ein Wert, der den Befehl gibt";
    /// Function from raw to physical.
    ToValue:
        "Raw value to {}: one step is {}.",
        "Rohwert in {}: ein Schritt ist {}.";
    /// What a FALSE means there.
    ToValueSpecial:
        "FALSE: the raw value is a special one and no quantity; value stays as it was.",
        "FALSE: der Rohwert ist ein besonderer und keine Größe; value bleibt, wie es war.";
    /// Without special values.
    ToValueAlways: "Always TRUE: no raw value is special.", "Immer TRUE: kein Rohwert ist ein besonderer.";
    /// Function from physical to raw.
    ToRaw:
        "{} to raw value, rounded to the nearest step, half a step away from zero. FALSE: outside {} to {} (raw {} to {}), a special value, or no number; raw stays as it was.",
        "{} in Rohwert, auf den nächsten Schritt gerundet, halbe von der Null weg. FALSE: außerhalb von {} bis {} (roh {} bis {}), ein besonderer Wert oder keine Zahl; raw bleibt, wie es war.";
    /// 64 bits in LREAL.
    Inexact:
        "LREAL has 53 bits: beyond 1125899906842624 steps the value is the nearest that there is, and none becomes a raw value.",
        "LREAL hat 53 Bits: jenseits von 1125899906842624 Schritten ist der Wert der nächstliegende, und keiner wird zum Rohwert.";
    /// A step that the user sets up.
    Formula:
        "The step is {} by the settings of the device; here it is that of the defaults.",
        "Der Schritt ist {} nach den Einstellungen des Geräts; hier ist es der der Vorgaben.";
    /// Entries that share a function.
    AlsoOf: "For {}.", "Für {}.";
    /// PDO that the device sends.
    Transmitted: "{}: sent by the device, input of the controller. {} bits.", "{}: vom Gerät gesendet, Eingang der Steuerung. {} Bits.";
    /// PDO that the device takes.
    Received: "{}: taken by the device, output of the controller. {} bits.", "{}: vom Gerät empfangen, Ausgang der Steuerung. {} Bits.";
    /// A structure is no image.
    NoImage:
        "Raw values in the order of the mapping; no image of the bytes, as the compiler may leave gaps.",
        "Rohwerte in der Reihenfolge des Mappings; kein Abbild der Bytes, denn der Compiler darf Lücken lassen.";
    /// A PDO that is off.
    SwitchedOff: "Switched off until its COB-ID says otherwise.", "Abgeschaltet, bis ihre COB-ID etwas anderes sagt.";
    /// A PDO without mapping.
    Empty: "Nothing is mapped.", "Nichts ist gemappt.";
    /// COB-ID.
    CanId: "CAN-ID", "CAN-ID";
    /// COB-ID of 29 bits.
    LongCanId: "CAN-ID of 29 bits", "CAN-ID mit 29 Bits";
    /// COB-ID without node.
    CanIdBase: "CAN-ID without the node-ID: add it", "CAN-ID ohne die Node-ID: diese addieren";
    /// Length of a frame.
    FrameLength: "bytes of the frame", "Bytes des Telegramms";
    /// Transmission type.
    Transmission: "transmission type", "Übertragungsart";
    /// Event timer.
    EventTimer: "event timer in ms", "Event-Timer in ms";
    /// Inhibit time.
    InhibitTime: "inhibit time in steps of 100 µs", "Sperrzeit in Schritten von 100 µs";
    /// A part of a value.
    PartMapped: "{} of {} bits are mapped", "{} von {} Bits sind gemappt";
    /// Not in the dictionary.
    Unknown: "no entry of the device", "kein Eintrag des Geräts";
    /// Bytes to structure.
    Unpack:
        "The raw values in the bytes of a frame, least significant byte first. A frame with fewer than {} bytes is none of this PDO: do not pass it.",
        "Die Rohwerte in den Bytes eines Telegramms, niederwertigstes Byte zuerst. Ein Telegramm mit weniger als {} Bytes ist keins dieser PDO: nicht übergeben.";
    /// Structure to bytes.
    Pack:
        "The bytes of a frame with these raw values, least significant byte first; {} bytes are sent. FALSE: a number has more bits than are mapped, and the bytes stay as they were.",
        "Die Bytes eines Telegramms mit diesen Rohwerten, niederwertigstes Byte zuerst; {} Bytes werden gesendet. FALSE: eine Zahl hat mehr Bits, als gemappt sind, und die Bytes bleiben, wie sie waren.";
    /// Block for what comes in.
    InBlock:
        "What {} says: quantities in their units, bits and states by name. A quantity whose _valid is FALSE stays as it was, because the raw value is a special one.",
        "Was {} sagt: Größen in ihren Einheiten, Bits und Zustände mit Namen. Eine Größe, deren _valid FALSE ist, bleibt, wie sie war, weil der Rohwert ein besonderer ist.";
    /// Block for what goes out.
    OutBlock:
        "Raw values for {} from quantities in their units. What cannot be sent is refused: its _accepted is FALSE, and its raw value stays as it was. Inputs begin with the defaults of the device.",
        "Rohwerte für {} aus Größen in ihren Einheiten. Was nicht gesendet werden kann, wird abgelehnt: sein _accepted ist FALSE, und sein Rohwert bleibt, wie er war. Eingänge beginnen mit den Vorgaben des Geräts.";
}

impl Phrase {
    /// The sentence with what differs, in order.
    pub(super) fn with(self, language: Language, parts: &[&str]) -> String {
        let mut pieces = self.text(language).split("{}");
        let mut sentence = pieces.next().unwrap_or_default().to_owned();
        for (piece, part) in pieces.zip(parts.iter().chain(std::iter::repeat(&""))) {
            sentence.push_str(part);
            sentence.push_str(piece);
        }
        sentence
    }
}
