// Reads an EDS file with node-canopen and prints what it read as JSON, one object or sub-object a line.
// node node_canopen.js NODE_MODULES FILE
'use strict';

const path = require('path');

for (const level of ['log', 'info', 'warn', 'error', 'debug']) {
    console[level] = (...text) => {
        throw new Error(`console.${level}: ${text.join(' ')}`);
    };
}
process.on('warning', (warning) => {
    throw warning;
});

const [modules, file] = process.argv.slice(2);
// The package's index.js wants a native CAN module; the EDS reader alone does not.
const { Eds } = require(path.resolve(modules, 'canopen', 'source', 'eds.js'));

const hex = (number) => number.toString(16).toUpperCase();

function print(line) {
    process.stdout.write(JSON.stringify(line) + '\n');
}

function valueOf(object) {
    const value = object.subNumber === undefined ? object.value : undefined;
    return ['number', 'bigint', 'boolean', 'string'].includes(typeof value) ? String(value) : undefined;
}

function printObject(section, object) {
    const { parameterName, objectType, dataType, accessType, pdoMapping, lowLimit, highLimit } = object;
    const { objFlags, defaultValue } = object;
    print({
        section, parameterName, objectType, dataType, accessType, pdoMapping, lowLimit, highLimit,
        objFlags, defaultValue, value: valueOf(object),
    });
}

const eds = Eds.fromFile(file);
print({ deviceInfo: eds.deviceInfo });
for (const [key, object] of eds.entries()) {
    const section = key.toUpperCase();
    printObject(section, object);
    (object._subObjects || []).forEach((sub, index) => printObject(`${section}sub${hex(index)}`, sub));
}
