//! What the application has to have for DOMAINs, to start from: functions that read and write parts as the stack calls them.

use od_spec::model::Family;

use super::super::prefix::Prefix;
use super::super::text::Text;
use super::objects::{Slot, StackObject};

/// The objects with DOMAINs, and these.
fn of<'o, 'a>(objects: &'o [StackObject<'a>]) -> Vec<(&'o StackObject<'a>, Vec<&'o Slot<'a>>)> {
    let domains = |object: &'o StackObject<'a>| -> Vec<&'o Slot<'a>> {
        let mut slots = object.slots();
        slots.retain(|slot| slot.entry.data_type.family() == Family::Domain);
        slots
    };
    objects
        .iter()
        .map(|object| (object, domains(object)))
        .filter(|(_, domains)| !domains.is_empty())
        .collect()
}

/// Everything after the head of the file; false where there are no DOMAINs.
pub(super) fn print(text: &mut Text, prefix: &Prefix, objects: &[StackObject<'_>]) -> bool {
    let objects = of(objects);
    text.comment(&prefix.in_text(
        "A start, to be copied to the sources of the application: this file is made anew with the dictionary. What is marked with `HERE` is to be replaced; until \
         then every access is refused. To be called after `OD_extendAll`: `OD_extendDomains`.",
    ));
    text.line("#include \"301/CO_ODinterface.h\"");
    text.line(&format!("#include \"{prefix}.h\""));
    text.line(&format!("#include \"{prefix}_extension.h\""));
    text.gap();
    text.line(&format!("ODR_t {prefix}_extendDomains(void);"));
    for (object, domains) in &objects {
        functions(text, object, domains);
    }
    text.gap();
    text.block(&format!("ODR_t {prefix}_extendDomains(void) {{"), "}", |text| {
        text.line("ODR_t outcome = ODR_OK;");
        text.gap();
        for (object, _) in &objects {
            let index = format!("{:04X}", object.object.index.0);
            text.block("if (outcome == ODR_OK) {", "}", |text| {
                text.line(&format!(
                    "outcome = {prefix}_extendBehind({prefix}_ENTRY_H{index}, &extension_{index});"
                ));
            });
        }
        text.line("return outcome;");
    });
    !objects.is_empty()
}

fn functions(text: &mut Text, object: &StackObject<'_>, domains: &[&Slot<'_>]) {
    let index = format!("{:04X}", object.object.index.0);
    let is_readable = domains.iter().any(|slot| slot.entry.access.is_readable());
    let is_writable = domains.iter().any(|slot| slot.entry.access.is_writable());
    let ids: Vec<String> = domains.iter().map(|slot| format!("{} {}", slot.id, slot.entry.name)).collect();
    // What else the object has lies in memory.
    let others = (object.slots().len() > domains.len()).then(|| {
        let subs = domains.iter().map(|slot| format!("(stream->subIndex != {}U)", slot.id.sub));
        subs.collect::<Vec<_>>().join(" && ")
    });
    text.gap();
    text.comment(&format!("{}.", ids.join(", ")));
    if is_readable {
        let head = format!("static ODR_t read_{index}");
        let parameters = ["OD_stream_t *stream", "void *buf", "OD_size_t count", "OD_size_t *countRead"];
        text.signature(&head, &parameters);
        text.block("{", "}", |text| {
            text.line("const OD_size_t length = 0U; /* HERE: the number of bytes */");
            text.line("const OD_size_t rest = length - stream->dataOffset;");
            text.line("const OD_size_t part = (rest < count) ? rest : count;");
            text.line("ODR_t outcome = ODR_NO_DATA;");
            original(text, others.as_deref(), "OD_readOriginal(stream, buf, count, countRead)");
            text.comment("HERE: put `part` bytes, from `stream->dataOffset` on, into `buf`; then ODR_OK.");
            text.line("(void)buf;");
            text.block("if (outcome == ODR_OK) {", "}", |text| {
                text.line("*countRead = part;");
                text.line("stream->dataOffset += part;");
                text.line("outcome = (part < rest) ? ODR_PARTIAL : ODR_OK;");
            });
            text.line("return outcome;");
        });
    }
    if is_writable {
        text.gap();
        let head = format!("static ODR_t write_{index}");
        let parameters =
            ["OD_stream_t *stream", "const void *buf", "OD_size_t count", "OD_size_t *countWritten"];
        text.signature(&head, &parameters);
        text.block("{", "}", |text| {
            text.line("ODR_t outcome = ODR_NO_RESOURCE;");
            original(text, others.as_deref(), "OD_writeOriginal(stream, buf, count, countWritten)");
            text.comment("HERE: take `count` bytes of `buf`, which go to `stream->dataOffset`; then ODR_OK.");
            text.line("(void)buf;");
            text.block("if (outcome == ODR_OK) {", "}", |text| {
                text.line("*countWritten = count;");
                text.line("stream->dataOffset += count;");
                text.comment("With the last part, the stack says how many bytes there are.");
                text.line("outcome = (stream->dataOffset == stream->dataLength) ? ODR_OK : ODR_PARTIAL;");
            });
            text.line("return outcome;");
        });
    }
    text.gap();
    let function = |kind: &str, is_there: bool| {
        if is_there { format!("{kind}_{index}") } else { format!("OD_{kind}Original") }
    };
    text.block(&format!("static OD_extension_t extension_{index} = {{"), "};", |text| {
        text.line(".object = NULL,");
        text.line(&format!(".read = {},", function("read", is_readable)));
        text.line(&format!(".write = {},", function("write", is_writable)));
    });
}

/// Leaves to the memory what is no DOMAIN.
fn original(text: &mut Text, others: Option<&str>, call: &str) {
    text.gap();
    if let Some(others) = others {
        text.block(&format!("if ({others}) {{"), "}", |text| text.line(&format!("return {call};")));
    }
}
