"""A controller for a few lines of Structured Text: evaluates what blark has read, and takes nothing lightly.

Both sides of an operation have one type, every number has to fit into the type that it goes into, and conversions are only those
that every tool makes alike: bits to a number of the same width or a wider one, a number to one that has it, whole numbers to LREAL.
How LREAL becomes a whole number differs from tool to tool; here it is chosen.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Callable

from blark import transform as tree

BITS = {"BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}
UNSIGNED = {"USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64}
SIGNED = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
WHOLE = {**BITS, **UNSIGNED, **SIGNED}
REALS = ("REAL", "LREAL")


def away(number: float) -> int:
    """Halves away from zero."""
    exact = Fraction(number)
    return math.floor(exact + Fraction(1, 2)) if exact >= 0 else math.ceil(exact - Fraction(1, 2))


# How tools make a whole number of LREAL.
ROUNDINGS: dict[str, Callable[[float], int]] = {"to even": round, "away": away, "cut off": math.trunc, "down": math.floor, "up": math.ceil}


class Fault(Exception):
    """Something that one controller does otherwise than another one, or that no compiler takes."""


class Return(Exception):
    """RETURN."""


def least_and_most(of_type: str) -> tuple[int, int]:
    width = WHOLE[of_type]
    return (-(1 << width - 1), (1 << width - 1) - 1) if of_type in SIGNED else (0, (1 << width) - 1)


def fits(of_type: str, value: Any) -> Any:
    """The value, if the type has it."""
    if of_type == "BOOL":
        if not isinstance(value, bool):
            raise Fault(f"{value!r} is no BOOL")
    elif of_type in WHOLE:
        least, most = least_and_most(of_type)
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            raise Fault(f"{value!r} is no {of_type}")
    elif of_type in REALS and (isinstance(value, bool) or not isinstance(value, float)):
        raise Fault(f"{value!r} is no {of_type}")
    return value


@dataclass
class Variable:
    name: str
    of_type: str
    init: Any = None


@dataclass
class Code:
    """A function or a function block."""

    name: str
    returns: str | None
    inputs: list[Variable] = field(default_factory=list)
    in_outs: list[Variable] = field(default_factory=list)
    outputs: list[Variable] = field(default_factory=list)
    others: list[Variable] = field(default_factory=list)
    body: Any = None


def text_of(node: Any) -> str:
    return str(node)


def type_of_init(init: Any) -> str:
    """The type in a declaration; of the only array there is, `FRAME`."""
    if isinstance(init, tree.ArrayTypeInitialization):
        ranges = [(text_of(one.start), text_of(one.stop)) for one in init.spec.subranges]
        if ranges != [("0", "7")] or text_of(init.spec.type.type_name).upper() != "BYTE":
            raise Fault(f"an array {ranges} of {init.spec.type}")
        return "FRAME"
    return text_of(init.spec.type)


class Controller:
    """What is declared, and how LREAL becomes a whole number."""

    def __init__(self, items: list[Any]) -> None:
        self.structures: dict[str, list[Variable]] = {}
        self.codes: dict[str, Code] = {}
        self.enums: dict[str, tuple[str, dict[str, int]]] = {}
        self.names: list[str] = []
        self.round = ROUNDINGS["to even"]
        for item in items:
            self.declare(item)

    def declare(self, item: Any) -> None:
        if isinstance(item, tree.DataTypeDeclaration):
            declaration = item.declaration
            name = text_of(declaration.name)
            self.names.append(name)
            if isinstance(declaration, tree.StructureTypeDeclaration):
                members = [variable for one in declaration.declarations for variable in self.variables(one)]
                self.structures[name.upper()] = members
            else:
                values = {}
                for value in declaration.init.spec.values:
                    values[text_of(value.name)] = self.literal(value.value)
                self.enums[name.upper()] = (text_of(declaration.init.spec.type_name), values)
        elif isinstance(item, (tree.Function, tree.FunctionBlock)):
            returns = text_of(item.return_type.type.type) if isinstance(item, tree.Function) else None
            code = Code(text_of(item.name), returns, body=item.body)
            for block in item.declarations:
                variables = [variable for one in block.items for variable in self.variables(one)]
                if isinstance(block, tree.InputDeclarations):
                    code.inputs += variables
                elif isinstance(block, tree.InputOutputDeclarations):
                    code.in_outs += variables
                elif isinstance(block, tree.OutputDeclarations):
                    code.outputs += variables
                else:
                    code.others += variables
            self.names.append(code.name)
            self.codes[code.name.upper()] = code
        else:
            raise Fault(f"{type(item).__name__} at the top of a file")

    def variables(self, declaration: Any) -> list[Variable]:
        of_type = type_of_init(declaration.init)
        value = getattr(declaration.init, "value", None)
        value = None if value is None else self.literal(value)
        names = declaration.variables
        return [Variable(text_of(one.variable.name), of_type, value) for one in names]

    def literal(self, node: Any) -> Any:
        return self.evaluate(node, {})[1]

    def zero(self, of_type: str) -> Any:
        if of_type in WHOLE:
            return 0
        if of_type == "BOOL":
            return False
        if of_type in REALS:
            return 0.0
        if of_type == "FRAME":
            return [0] * 8
        members = self.structures.get(of_type.upper())
        if members is None:
            raise Fault(f"the type {of_type} is unknown")
        return {one.name.upper(): self.start(one) for one in members}

    def start(self, variable: Variable) -> Any:
        if variable.init is None:
            return self.zero(variable.of_type)
        return fits(variable.of_type, variable.init)

    # Running

    def call(self, name: str, **arguments: Any) -> tuple[Any, dict[str, Any]]:
        """The result of a function, and its VAR_IN_OUT afterwards."""
        code = self.codes[name.upper()]
        frame = {one.name.upper(): (one.of_type, self.start(one)) for one in code.others}
        given = {key.upper(): value for key, value in arguments.items()}
        wanted = {one.name.upper(): one for one in code.inputs + code.in_outs}
        if set(given) != set(wanted):
            raise Fault(f"{name} takes {sorted(wanted)}, not {sorted(given)}")
        for key, one in wanted.items():
            frame[key] = (one.of_type, fits(one.of_type, given[key]))
        frame[code.name.upper()] = (code.returns, self.zero(code.returns))
        try:
            self.run(code.body, frame)
        except Return:
            pass
        return frame[code.name.upper()][1], {one.name: frame[one.name.upper()][1] for one in code.in_outs}

    def instance(self, name: str) -> dict[str, tuple[str, Any]]:
        """An instance of a function block."""
        code = self.codes[name.upper()]
        return {one.name.upper(): (one.of_type, self.start(one)) for one in code.inputs + code.outputs + code.others}

    def cycle(self, name: str, frame: dict[str, tuple[str, Any]], **inputs: Any) -> None:
        """Calls an instance of a function block."""
        code = self.codes[name.upper()]
        for key, value in inputs.items():
            of_type, _ = frame[key.upper()]
            if key.upper() not in {one.name.upper() for one in code.inputs}:
                raise Fault(f"{name} has no input {key}")
            frame[key.upper()] = (of_type, fits(of_type, value))
        try:
            self.run(code.body, frame)
        except Return:
            pass

    def run(self, statements: Any, frame: dict[str, tuple[str, Any]]) -> None:
        for statement in statements.statements if statements is not None else []:
            self.step(statement, frame)

    def step(self, statement: Any, frame: dict[str, tuple[str, Any]]) -> None:
        if isinstance(statement, tree.AssignmentStatement):
            [target] = statement.variables
            of_type, value = self.evaluate(statement.expression, frame)
            self.assign(target, of_type, value, frame)
        elif isinstance(statement, tree.IfStatement):
            for condition, body in [(statement.if_expression, statement.statements)] + [(one.if_expression, one.statements) for one in statement.else_ifs]:
                if self.boolean(condition, frame):
                    self.run(body, frame)
                    return
            if statement.else_clause is not None:
                self.run(statement.else_clause.statements, frame)
        elif isinstance(statement, tree.CaseStatement):
            _, value = self.evaluate(statement.expression, frame)
            for case in statement.cases:
                if value in [self.literal(one) for one in case.matches]:
                    self.run(case.statements, frame)
                    return
            if statement.else_clause is not None:
                self.run(statement.else_clause.statements, frame)
        elif isinstance(statement, tree.ReturnStatement):
            raise Return
        else:
            raise Fault(f"the statement {type(statement).__name__}")

    def boolean(self, expression: Any, frame: dict[str, tuple[str, Any]]) -> bool:
        of_type, value = self.evaluate(expression, frame)
        if of_type != "BOOL":
            raise Fault(f"{expression} is no condition")
        return value

    def place(self, node: Any, frame: dict[str, tuple[str, Any]]) -> tuple[str, Callable[[], Any], Callable[[Any], None]]:
        """Type of a variable, how it is read and how it is written."""
        if isinstance(node, tree.SimpleVariable):
            key = text_of(node.name).upper()
            if key not in frame:
                raise Fault(f"{key} is unknown")
            of_type = frame[key][0]
            return of_type, lambda: frame[key][1], lambda value: frame.__setitem__(key, (of_type, value))
        if not isinstance(node, tree.MultiElementVariable):
            raise Fault(f"the variable {node}")
        of_type, read, _ = self.place(node.name, frame)
        [element] = node.elements
        if isinstance(element, tree.FieldSelector):
            key = text_of(element.field.name).upper()
            members = {one.name.upper(): one.of_type for one in self.structures.get(of_type.upper(), [])}
            if key not in members:
                raise Fault(f"{of_type} has no {key}")
            return members[key], lambda: read()[key], lambda value: read().__setitem__(key, value)
        [subscript] = element.subscripts
        index = self.literal(subscript)
        if of_type != "FRAME" or not 0 <= index < 8:
            raise Fault(f"{node}")
        return "BYTE", lambda: read()[index], lambda value: read().__setitem__(index, value)

    def assign(self, target: Any, of_type: str | None, value: Any, frame: dict[str, tuple[str, Any]]) -> None:
        wanted, _, write = self.place(target, frame)
        if of_type is not None and of_type.upper() != wanted.upper():
            raise Fault(f"{of_type} goes into {target}, which is {wanted}")
        if isinstance(value, dict):
            value = dict(value)
        write(fits(wanted, value))

    def evaluate(self, node: Any, frame: dict[str, tuple[str, Any]]) -> tuple[str | None, Any]:
        """Type and value; a literal has no type of its own except BOOL, and LREAL with a decimal point."""
        if isinstance(node, tree.ParenthesizedExpression):
            return self.evaluate(node.expr, frame)
        if isinstance(node, tree.Boolean):
            return "BOOL", text_of(node.value).upper() == "TRUE"
        if isinstance(node, tree.Real):
            return "LREAL", float(text_of(node.value))
        if isinstance(node, tree.HexInteger):
            return self.typed(node, int(text_of(node.value), 16))
        if isinstance(node, tree.Integer):
            return self.typed(node, int(text_of(node.value)))
        if isinstance(node, tree.String):
            return "STRING", text_of(node.value)
        if isinstance(node, (tree.SimpleVariable, tree.MultiElementVariable)):
            of_type, read, _ = self.place(node, frame)
            return of_type, read()
        if isinstance(node, tree.UnaryOperation):
            of_type, value = self.evaluate(node.expr, frame)
            if text_of(node.op) == "-" and of_type in (None, "LREAL"):
                return of_type, -value
            if text_of(node.op).upper() == "NOT" and of_type == "BOOL":
                return of_type, not value
            raise Fault(f"{node.op} before {of_type}")
        if isinstance(node, tree.BinaryOperation):
            return self.binary(text_of(node.op).upper(), self.evaluate(node.left, frame), self.evaluate(node.right, frame))
        if isinstance(node, tree.FunctionCall):
            return self.function(node, frame)
        raise Fault(f"the expression {type(node).__name__}")

    @staticmethod
    def typed(node: Any, value: int) -> tuple[str | None, int]:
        name = getattr(node, "type_name", None)
        return (None, value) if name is None else (text_of(name), fits(text_of(name), value))

    def binary(self, operator: str, left: tuple[str | None, Any], right: tuple[str | None, Any]) -> tuple[str | None, Any]:
        (one_type, one), (other_type, other) = left, right
        of_type = one_type or other_type
        if None not in (one_type, other_type) and one_type != other_type:
            raise Fault(f"{one_type} {operator} {other_type}")
        if of_type is None:
            raise Fault(f"two literals with {operator} between them")
        for value in (one, other):
            fits(of_type, value)
        comparisons = {"=": one == other, "<>": one != other}
        if of_type not in BITS and of_type != "BOOL":
            comparisons |= {"<": one < other, "<=": one <= other, ">": one > other, ">=": one >= other}
        if operator in comparisons:
            return "BOOL", comparisons[operator]
        if operator in ("AND", "OR"):
            if of_type == "BOOL":
                return of_type, (one and other) if operator == "AND" else (one or other)
            if of_type in BITS:
                return of_type, one & other if operator == "AND" else one | other
        elif of_type == "LREAL":
            return of_type, {"+": lambda: one + other, "-": lambda: one - other, "*": lambda: one * other, "/": lambda: one / other}[operator]()
        elif of_type in UNSIGNED or of_type in SIGNED:
            if operator in ("/", "MOD") and (one < 0 or other <= 0):
                raise Fault(f"{one} {operator} {other}")
            result = {"+": lambda: one + other, "-": lambda: one - other, "*": lambda: one * other, "/": lambda: one // other, "MOD": lambda: one % other}[operator]()
            return of_type, fits(of_type, result)
        raise Fault(f"{of_type} {operator} {of_type}")

    def function(self, node: Any, frame: dict[str, tuple[str, Any]]) -> tuple[str | None, Any]:
        name = text_of(node.name.name)
        conversion = re.fullmatch(r"([A-Z]+)_TO_([A-Z]+)", name)
        if name.upper() not in self.codes and conversion:
            [parameter] = node.parameters
            of_type, value = self.evaluate(parameter.value, frame)
            if of_type != conversion[1]:
                raise Fault(f"{name} of {of_type}")
            return conversion[2], self.convert(conversion[1], conversion[2], value)
        code = self.codes.get(name.upper())
        if code is None:
            raise Fault(f"the function {name} is unknown")
        given: dict[str, Any] = {}
        back: dict[str, Callable[[Any], None]] = {}
        types = {one.name.upper(): one.of_type for one in code.inputs + code.in_outs}
        for parameter in node.parameters:
            key = text_of(parameter.name.name).upper()
            of_type, value = self.evaluate(parameter.value, frame)
            if of_type is not None and of_type.upper() != types[key].upper():
                raise Fault(f"{key} of {name} is {types[key]}, not {of_type}")
            given[key] = value
            if key in {one.name.upper() for one in code.in_outs}:
                back[key] = self.place(parameter.value, frame)[2]
        result, after = self.call(name, **given)
        for key, value in after.items():
            back[key.upper()](value)
        return code.returns, result

    def convert(self, source: str, target: str, value: Any) -> Any:
        if source in BITS and target in WHOLE and BITS[source] <= WHOLE[target]:
            if target in SIGNED:
                if BITS[source] != SIGNED[target]:
                    raise Fault(f"{source} to {target}")
                return value - (1 << BITS[source]) if value >> BITS[source] - 1 else value
            return value
        if target in BITS and source in SIGNED and SIGNED[source] == BITS[target]:
            return value % (1 << BITS[target])
        if target in BITS and source in UNSIGNED:
            return fits(target, value)
        if source in WHOLE and source not in BITS and target in WHOLE and target not in BITS:
            return fits(target, value)
        if source in WHOLE and source not in BITS and target == "LREAL":
            return float(value)
        if source == "LREAL" and target in SIGNED:
            if math.isnan(value) or math.isinf(value):
                raise Fault(f"{value} to {target}")
            return fits(target, self.round(value))
        raise Fault(f"{source} to {target}")
