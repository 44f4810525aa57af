// Reads every entry of an EDS file from a node, with node-canopen over SLCAN and TCP, and prints one line of JSON for each.
// node node_canopen_reads.js NODE_MODULES EDS NODE_ID HOST PORT
'use strict';

const Module = require('module');
const net = require('net');
const path = require('path');

const [modules, file, nodeId, host, port] = process.argv.slice(2);
const source = path.resolve(modules, 'canopen', 'source');

// A native module for the checksums of block transfers, of which there are none here.
const load = Module._load;
Module._load = (name, ...rest) => (name === 'node-crc' ? { crc: () => { throw new Error('no checksums'); } } : load(name, ...rest));

const { Eds } = require(path.join(source, 'eds.js'));
const { SdoClient } = require(path.join(source, 'protocol', 'sdo_client.js'));

const device = Number(nodeId);
const own = new Eds();
own.addSdoClientParameter(device, 0x600 + device, 0x580 + device);
const client = new SdoClient(own);
const socket = net.connect(Number(port), host);
socket.setNoDelay(true);

client.on('message', ({ id, data }) => {
    const hex = data.toString('hex').toUpperCase();
    socket.write(`t${id.toString(16).padStart(3, '0').toUpperCase()}${data.length}${hex}\r`);
});

let rest = '';
socket.on('data', (bytes) => {
    const lines = (rest + bytes.toString('latin1')).split('\r');
    rest = lines.pop();
    for (const line of lines) {
        if (line.startsWith('t')) {
            const data = Buffer.from(line.slice(5, 5 + 2 * Number(line[4])), 'hex');
            client.receive({ id: parseInt(line.slice(1, 4), 16), data });
        }
    }
});

async function read(index, subIndex) {
    try {
        const data = await client.upload({ deviceId: device, index, subIndex, timeout: 60000 });
        return { index, sub: subIndex, data: data.toString('hex') };
    } catch (error) {
        return { index, sub: subIndex, abort: error.code, said: error.message };
    }
}

async function main() {
    socket.write('O\r');
    client.start();
    for (const [key, object] of Eds.fromFile(file).entries()) {
        const index = parseInt(key, 16);
        const subs = object._subObjects && object._subObjects.length ? Object.keys(object._subObjects) : ['0'];
        for (const sub of subs) {
            process.stdout.write(JSON.stringify(await read(index, Number(sub))) + '\n');
        }
    }
    socket.end('C\r');
}

socket.on('connect', () => main().catch((error) => {
    process.stderr.write(`${error.stack}\n`);
    process.exit(1);
}));
