// Says of each file named on standard input, in a line of JSON, why node-canopen refuses it; null if it accepts it.
// node accepts.js NODE_MODULES
'use strict';

const fs = require('fs');
const path = require('path');

for (const level of ['log', 'info', 'warn', 'error', 'debug']) {
    console[level] = () => {};
}

// The package's index.js wants a native CAN module; the EDS reader alone does not.
const { Eds } = require(path.resolve(process.argv[2], 'canopen', 'source', 'eds.js'));

function reason(file) {
    try {
        Eds.fromFile(file);
        return null;
    } catch (error) {
        return String(error).split('\n')[0];
    }
}

for (const file of fs.readFileSync(0, 'utf8').split('\n').filter((line) => line !== '')) {
    fs.writeSync(1, JSON.stringify(reason(file)) + '\n');
}
