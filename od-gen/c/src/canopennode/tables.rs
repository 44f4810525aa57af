//! `OD_rules.c`: the rows of the rules.

use od_gen::plan::{Condition, Plan, PlannedAlias, Sum};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{DataType, EntryId, Fact, Outside, Rounding, Value};

use super::super::conditions::{self, Entries};
use super::super::literal::Integer;
use super::super::text::Text;
use super::node_id::NodeIdDefault;
use super::rules::{LISTED, LOCKED, NONE, Number, Rule, Rules, size};

const I64: Integer = Integer { signed: true, bits: 64 };
const U64: Integer = Integer { signed: false, bits: 64 };

/// Everything after the head of the file.
pub(super) fn print(
    text: &mut Text,
    plan: &Plan<'_>,
    rules: &Rules<'_, '_>,
    node_ids: &[NodeIdDefault<'_>],
    diagnostics: &mut Diagnostics,
) {
    text.line("#include \"OD_extension.h\"");
    text.gap();
    text.line("#include <stddef.h>");
    if !rules.left_to_stack.is_empty() {
        text.gap();
        let left: Vec<String> = rules.left_to_stack.iter().map(EntryId::to_string).collect();
        text.comment(&format!(
            "Not here, because the stack extends these objects itself: the rules of {}.",
            left.join(", ")
        ));
    }
    conditions(text, plan, rules, diagnostics);
    limits(text, rules);
    values(text, rules);
    views(text, plan, rules);
    rows(text, rules);
    values_with_node_id(text, node_ids);
}

/// A list that no C can be without: an empty one has a row that nothing refers to.
fn list(text: &mut Text, open: &str, rows: &[String], none: &str) {
    text.gap();
    text.block(&format!("{open} = {{"), "};", |text| {
        for row in rows {
            text.line(&format!("{row},"));
        }
        if rows.is_empty() {
            text.line(none);
        }
    });
}

fn limits(text: &mut Text, rules: &Rules<'_, '_>) {
    let rows: Vec<String> =
        rules.limits.iter().map(|(low, high)| format!("{{{}, {}}}", wide(*low), wide(*high))).collect();
    list(text, "const OD_ruleLimits_t OD_ruleLimits[]", &rows, "{0, 0}");
}

fn values(text: &mut Text, rules: &Rules<'_, '_>) {
    let mut rows = Vec::new();
    for (at, values) in rules.values.iter().enumerate() {
        text.gap();
        text.block(&format!("static const int64_t values_{at}[] = {{"), "};", |text| {
            text.items(values.iter().map(|value| wide(*value)));
        });
        rows.push(format!("{{values_{at}, {}U}}", values.len()));
    }
    list(text, "const OD_ruleValues_t OD_ruleValues[]", &rows, "{NULL, 0U}");
}

fn wide(value: i64) -> String {
    I64.literal(value.into())
}

/// Numbers of entries that conditions are about are read before anything is computed.
fn conditions(text: &mut Text, plan: &Plan<'_>, rules: &Rules<'_, '_>, diagnostics: &mut Diagnostics) {
    let mut rows = Vec::new();
    for (at, position) in rules.conditions.iter().enumerate() {
        let Some(condition) = plan.conditions.get(usize::from(*position)) else { continue };
        if !condition.narrow {
            let message = format!(
                "`{}` needs numbers of more than 64 bits, which C does not have everywhere",
                condition.text
            );
            let entry = rules.first_under(at).and_then(|id| plan.device.entry(id));
            let place = entry.map_or(plan.device.span, |entry| entry.place(Fact::WriteCondition));
            diagnostics.push(
                Diagnostic::new(codes::NOT_IN_FIRMWARE, place, message)
                    .help("use narrower types, or a simpler fraction in the units of the entries"),
            );
            continue;
        }
        text.gap();
        text.doc(&format!("Whether {}.", condition.text));
        text.block(&format!("static bool_t condition_{at}(void) {{"), "}", |text| {
            let entries = Read(entries_of(condition));
            for number in 0..entries.0.len() {
                text.line(&format!("int64_t n{number} = 0;"));
            }
            let mut reads = Vec::new();
            for (number, id) in entries.0.iter().enumerate() {
                let data_type = plan.device.entry(*id).map_or(DataType::Unsigned8, |entry| entry.data_type);
                text.line(&format!(
                    "const bool_t r{number} = OD_ruleNumber(0x{:04X}U, {}U, {}, {}U, &n{number});",
                    id.index.0,
                    id.sub,
                    Number::of(data_type).name(),
                    size(data_type)
                ));
                reads.push(format!("r{number}"));
            }
            let holds = conditions::holds(plan, &entries, condition);
            reads.push(format!("({holds})"));
            text.broken(&format!("return (bool_t)({});", reads.join(" && ")));
        });
        rows.push(format!("condition_{at}"));
    }
    list(text, "const OD_ruleCondition_t OD_ruleConditions[]", &rows, "NULL");
}

fn entries_of(condition: &Condition) -> Vec<EntryId> {
    fn collect(sum: &Sum, ids: &mut Vec<EntryId>) {
        match sum {
            Sum::Number(_) => {}
            Sum::Entry(id) | Sum::Bit(id, _) => ids.push(*id),
            Sum::Binary(left, _, right) => {
                collect(left, ids);
                collect(right, ids);
            }
        }
    }
    let mut ids = Vec::new();
    for compare in condition.alternatives.iter().flatten() {
        for sum in [&compare.left, &compare.right].into_iter().chain(&compare.divisors) {
            collect(sum, &mut ids);
        }
    }
    ids.sort_unstable();
    ids.dedup();
    ids
}

/// The entries that a condition is about, as they have been read: ascending; the first one is `n0`.
struct Read(Vec<EntryId>);

impl Entries for Read {
    fn number(&self, id: EntryId) -> String {
        format!("n{}", self.0.binary_search(&id).unwrap_or_default())
    }

    fn count(&self, id: EntryId) -> String {
        // It has been read as a number with a sign.
        format!("(uint64_t){} ^ 0x8000000000000000ULL", self.number(id))
    }
}

fn views(text: &mut Text, plan: &Plan<'_>, rules: &Rules<'_, '_>) {
    let rows: Vec<String> = rules.aliases(plan).into_iter().filter_map(|alias| view(plan, alias)).collect();
    // What reads them is compiled where there are some.
    if !rows.is_empty() {
        list(text, "const OD_ruleView_t OD_ruleViews[]", &rows, "");
    }
}

fn view(plan: &Plan<'_>, alias: &PlannedAlias) -> Option<String> {
    let target = plan.entry(alias.target)?;
    let rounding = match alias.rounding {
        Rounding::Down => "OD_ROUND_DOWN",
        Rounding::Up => "OD_ROUND_UP",
        Rounding::Nearest => "OD_ROUND_NEAREST",
        Rounding::Zero => "OD_ROUND_ZERO",
    };
    let outside = match alias.outside {
        Outside::Saturate => "OD_OUTSIDE_SATURATE",
        Outside::Wrap => "OD_OUTSIDE_WRAP",
        Outside::Abort => "OD_OUTSIDE_ABORT",
    };
    let (low, high) = alias.data_type.range()?;
    let (low_shown, high_shown) = target.entry.data_type.range()?;
    Some(format!(
        "{{0x{:04X}U, {}U, {}, {}U, {rounding}, {outside}, {}U, {}U, {}, {}, {}, {}}}",
        target.id.index.0,
        target.id.sub,
        Number::of(target.entry.data_type).name(),
        size(target.entry.data_type),
        alias.numerator,
        alias.denominator,
        I64.literal(low),
        I64.literal(high),
        I64.literal(low_shown),
        I64.literal(high_shown)
    ))
}

fn rows(text: &mut Text, rules: &Rules<'_, '_>) {
    let (mut of_entries, mut of_objects) = (Vec::new(), Vec::new());
    for ruled in &rules.objects {
        let first = of_entries.len();
        for row in &ruled.rules {
            of_entries
                .push((ruled.object, format!("{{{}U, {}U, {}}}", row.first, row.last, members(&row.rule))));
        }
        of_objects.push(format!(
            "{{0x{:04X}U, {first}U, {}U}}",
            ruled.object.object.index.0,
            ruled.rules.len()
        ));
    }
    text.gap();
    text.comment("First and last sub-index, kind and size of the number, flags, and rows of limits, values, condition and view.");
    text.block("const OD_rule_t OD_rules[] = {", "};", |text| {
        let mut named = None;
        for (object, row) in &of_entries {
            if named != Some(object.object.index) {
                text.comment(&format!("{} {}", object.object.index, object.object.name));
                named = Some(object.object.index);
            }
            text.line(&format!("{row},"));
        }
        if of_entries.is_empty() {
            text.line("{0U, 0U, OD_NUMBER_NONE, 0U, 0U, OD_NO_ROW, OD_NO_ROW, OD_NO_ROW, OD_NO_ROW}");
        }
    });
    list(text, "const OD_ruledObject_t OD_ruledObjects[]", &of_objects, "{0U, 0U, 0U}");
    text.gap();
    text.line(&format!("const uint16_t OD_ruledObjectsCount = {}U;", of_objects.len()));
    text.line(&format!("OD_extension_t *OD_extensionsBehind[{}];", of_objects.len().max(1)));
    let requestable: Vec<String> =
        rules.requestable.iter().map(|index| format!("0x{:04X}U", index.0)).collect();
    text.gap();
    text.comment("Objects with flags by which the application requests the TPDOs that map them.");
    text.block("const uint16_t OD_requestable[] = {", "};", |text| {
        if requestable.is_empty() {
            text.line("0U");
        }
        text.items(requestable.iter().cloned());
    });
    text.gap();
    text.line(&format!("const uint16_t OD_requestableCount = {}U;", requestable.len()));
    text.line("#if OD_FLAGS_PDO_SIZE > 0");
    text.line(&format!("OD_extension_t OD_requestableExtensions[{}];", requestable.len().max(1)));
    text.line("#endif");
}

fn members(rule: &Rule) -> String {
    let flags: Vec<&str> = [(LOCKED, "OD_RULE_LOCKED"), (LISTED, "OD_RULE_LISTED")]
        .into_iter()
        .filter(|(flag, _)| rule.flags & flag != 0)
        .map(|(_, name)| name)
        .collect();
    let flags = if flags.is_empty() { "0U".to_owned() } else { flags.join(" | ") };
    let row = |row: u16| if row == NONE { "OD_NO_ROW".to_owned() } else { format!("{row}U") };
    format!(
        "{}, {}U, {flags}, {}, {}, {}, {}",
        rule.number.name(),
        rule.size,
        row(rule.limits),
        row(rule.values),
        row(rule.condition),
        row(rule.view)
    )
}

fn values_with_node_id(text: &mut Text, node_ids: &[NodeIdDefault<'_>]) {
    let rows: Vec<String> = node_ids
        .iter()
        .map(|default| {
            let data_type = default.entry.data_type;
            let raw = default
                .entry
                .default
                .as_ref()
                .and_then(|value: &Value| value.integer_for(0))
                .unwrap_or_default();
            format!(
                "{{0x{:04X}U, {}U, {}, {}U, {}}}",
                default.id.index.0,
                default.id.sub,
                Number::of(data_type).name(),
                size(data_type),
                U64.literal(raw)
            )
        })
        .collect();
    list(text, "const OD_nodeIdValue_t OD_nodeIdValues[]", &rows, "{0U, 0U, 0U, 0U, 0U}");
    text.gap();
    text.line(&format!("const uint16_t OD_nodeIdValuesCount = {}U;", rows.len()));
}
