/* The extension next to the stack, as an application meets it: the dictionary is that of tests/tests/canopennode/extension.rs. */
#include <stdio.h>
#include <string.h>

#include "301/CO_ODinterface.h"
#include "OD.h"
#include "OD_extension.h"

static unsigned failures = 0U;

static void expect_at(int line, const char *what, long found, long expected) {
    if (found != expected) {
        (void)printf("line %d: %s: %ld, expected %ld\n", line, what, found, expected);
        failures++;
    }
}

#define EXPECT(found, expected) expect_at(__LINE__, #found, (long)(found), (long)(expected))

static bool_t unlocked = false;

static bool_t is_unlocked(void) {
    return unlocked;
}

static ODR_t set(uint16_t index, uint8_t sub, const void *value, OD_size_t length) {
    OD_IO_t io;
    OD_size_t written = 0U;
    ODR_t outcome = OD_getSub(OD_find(OD, index), sub, &io, false);
    if (outcome == ODR_OK) {
        outcome = io.write(&io.stream, value, length, &written);
    }
    if (outcome == ODR_OK) {
        EXPECT(written, length);
    }
    return outcome;
}

static ODR_t set_u16(uint16_t index, uint8_t sub, uint16_t value) {
    return set(index, sub, &value, sizeof(value));
}

static uint16_t get_u16(uint16_t index, uint8_t sub) {
    OD_IO_t io;
    OD_size_t count = 0U;
    uint16_t value = 0U;
    EXPECT(OD_getSub(OD_find(OD, index), sub, &io, false), ODR_OK);
    EXPECT(io.read(&io.stream, &value, sizeof(value), &count), ODR_OK);
    EXPECT(count, sizeof(value));
    return value;
}

static uint32_t get_u32(uint16_t index, uint8_t sub) {
    OD_IO_t io;
    OD_size_t count = 0U;
    uint32_t value = 0U;
    EXPECT(OD_getSub(OD_find(OD, index), sub, &io, false), ODR_OK);
    EXPECT(io.read(&io.stream, &value, sizeof(value), &count), ODR_OK);
    return value;
}

/* An extension of the application: counts, and refuses 77. */
typedef struct {
    unsigned reads;
    unsigned writes;
} counts_t;

static ODR_t counted_read(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead) {
    ((counts_t *)stream->object)->reads++;
    return OD_readOriginal(stream, buf, count, countRead);
}

static ODR_t counted_write(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten) {
    uint16_t value = 0U;
    ((counts_t *)stream->object)->writes++;
    if (count == sizeof(value)) {
        (void)memcpy(&value, buf, sizeof(value));
    }
    return (value == 77U) ? ODR_DATA_LOC_CTRL : OD_writeOriginal(stream, buf, count, countWritten);
}

/* A DOMAIN that comes in parts. */
static uint8_t domain[16];
static OD_size_t domain_length = 0U;

static ODR_t domain_write(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten) {
    (void)memcpy(&domain[stream->dataOffset], buf, count);
    stream->dataOffset += count;
    domain_length = stream->dataOffset;
    *countWritten = count;
    return ODR_OK;
}

/* What a driver's list of storage looks like. */
typedef struct {
    void *addr;
    size_t len;
    uint8_t subIndexOD;
    uint8_t attr;
    const char *filename;
} CO_storage_entry_t;

static const CO_storage_entry_t storage[] = {OD_STORAGE_ENTRIES};
static const CO_storage_entry_t with_file[] = {{OD_STORAGE_PERSIST_APP, .filename = "app"}};

int main(void) {
    static counts_t counts = {0U, 0U};
    static OD_extension_t own = {.object = &counts, .read = counted_read, .write = counted_write};
    static OD_extension_t own_domain = {.object = NULL, .read = NULL, .write = domain_write};
    static OD_extension_t only_read = {.object = &counts, .read = counted_read, .write = NULL};
    uint8_t byte = 2U;
    uint32_t word = 0U;
    OD_IO_t io;
    OD_size_t done = 0U;

    /* Before the rules are there, nothing is kept. */
    EXPECT(set_u16(0x2000U, 0U, 5000U), ODR_OK);
    OD_extendAll(NULL);
    EXPECT(set_u16(0x2000U, 0U, 5000U), ODR_VALUE_HIGH);
    EXPECT(set_u16(0x2000U, 0U, 9U), ODR_VALUE_LOW);
    EXPECT(set_u16(0x2000U, 0U, 10U), ODR_OK);
    EXPECT(set_u16(0x2000U, 0U, 65535U), ODR_OK);
    EXPECT(set_u16(0x2000U, 0U, 1000U), ODR_OK);

    /* Lengths, also where nothing else looks at them. */
    EXPECT(set(0x2000U, 0U, &byte, 1U), ODR_DATA_SHORT);
    EXPECT(set(0x2000U, 0U, &word, 4U), ODR_DATA_LONG);

    /* An enum, a BOOLEAN, a text. */
    EXPECT(set(0x2001U, 0U, &byte, 1U), ODR_INVALID_VALUE);
    byte = 3U;
    EXPECT(set(0x2001U, 0U, &byte, 1U), ODR_OK);
    EXPECT(set(0x2002U, 0U, &byte, 1U), ODR_INVALID_VALUE);
    byte = 1U;
    EXPECT(set(0x2002U, 0U, &byte, 1U), ODR_OK);
    EXPECT(set(0x2003U, 0U, "abcdef\0\0", 8U), ODR_OK);
    EXPECT(set(0x2003U, 0U, "abc\0ef\0\0", 8U), ODR_INVALID_VALUE);
    EXPECT(set(0x2003U, 0U, "abc\tef\0\0", 8U), ODR_INVALID_VALUE);
    /* The same in parts. */
    EXPECT(OD_getSub(OD_find(OD, 0x2003U), 0U, &io, false), ODR_OK);
    EXPECT(io.write(&io.stream, "ab", 2U, &done), ODR_PARTIAL);
    EXPECT(io.write(&io.stream, "cdefgh", 6U, &done), ODR_OK);
    EXPECT(memcmp(OD_RAM.x2003_text, "abcdefgh", 9U), 0);
    EXPECT(OD_getSub(OD_find(OD, 0x2003U), 0U, &io, false), ODR_OK);
    EXPECT(io.write(&io.stream, "a\0", 2U, &done), ODR_PARTIAL);
    EXPECT(io.write(&io.stream, "cdefgh", 6U, &done), ODR_INVALID_VALUE);

    /* Elements of an array, of which each has the rule, and one after them that has none. */
    EXPECT(set_u16(0x2004U, 3U, 8U), ODR_VALUE_HIGH);
    EXPECT(set_u16(0x2004U, 3U, 7U), ODR_OK);
    EXPECT(OD_RAM.x2004_list[2], 7);

    /* A lock: never open without a function, and then as it says. */
    EXPECT(set_u16(0x2005U, 0U, 1U), ODR_DATA_DEV_STATE);
    OD_extendAll(is_unlocked);
    EXPECT(set_u16(0x2005U, 0U, 1U), ODR_DATA_DEV_STATE);
    unlocked = true;
    EXPECT(set_u16(0x2005U, 0U, 1U), ODR_OK);
    unlocked = false;

    /* A write condition between entries of two scales: 2006h in mV while 2000h, in V, is at least 2. */
    EXPECT(set_u16(0x2000U, 0U, 19U), ODR_OK);
    EXPECT(set_u16(0x2006U, 0U, 5U), ODR_DATA_DEV_STATE);
    EXPECT(set_u16(0x2000U, 0U, 20U), ODR_OK);
    EXPECT(set_u16(0x2006U, 0U, 5U), ODR_OK);

    /* A view: a thousandth, rounded down, saturated; written exactly or not at all. */
    word = 5999U;
    EXPECT(set(0x2007U, 0U, &word, 4U), ODR_OK);
    EXPECT(get_u16(0x2008U, 0U), 5);
    word = 70000000U;
    EXPECT(set(0x2007U, 0U, &word, 4U), ODR_OK);
    EXPECT(get_u16(0x2008U, 0U), 65535);
    EXPECT(set_u16(0x2008U, 0U, 12U), ODR_OK);
    EXPECT(OD_RAM.x2007_wide, 12000);
    word = 100000001U;
    EXPECT(set(0x2007U, 0U, &word, 4U), ODR_VALUE_HIGH);
    EXPECT(OD_RAM.x2007_wide, 12000);

    /* A DOMAIN has no data until the application has something there. */
    EXPECT(set(0x2009U, 0U, "abc", 3U), ODR_UNSUPP_ACCESS);
    EXPECT(OD_extendBehind(OD_ENTRY_H2009, &own_domain), ODR_OK);
    EXPECT(OD_getSub(OD_find(OD, 0x2009U), 0U, &io, false), ODR_OK);
    EXPECT(io.write(&io.stream, "abc", 3U, &done), ODR_OK);
    EXPECT(io.write(&io.stream, "de", 2U, &done), ODR_OK);
    EXPECT((domain_length == 5U) && (memcmp(domain, "abcde", 5U) == 0), 1);
    EXPECT(io.read(&io.stream, domain, 5U, &done), ODR_UNSUPP_ACCESS);

    /* An extension of the application sees what the rules allow, and has the last word. */
    EXPECT(OD_extendBehind(OD_ENTRY_H2000, &own), ODR_OK);
    EXPECT(set_u16(0x2000U, 0U, 5000U), ODR_VALUE_HIGH);
    EXPECT(counts.writes, 0);
    EXPECT(set_u16(0x2000U, 0U, 77U), ODR_DATA_LOC_CTRL);
    EXPECT(set_u16(0x2000U, 0U, 78U), ODR_OK);
    EXPECT((counts.writes == 2U) && (OD_RAM.x2000_set_point == 78U), 1);
    counts.reads = 0U;
    EXPECT(get_u16(0x2000U, 0U), 78);
    EXPECT(counts.reads, 1);
    /* It is asked for what conditions are about, too. */
    EXPECT(set_u16(0x2006U, 0U, 6U), ODR_OK);
    EXPECT(counts.reads, 2);
    EXPECT(OD_extendBehind(OD_ENTRY_H2000, &only_read), ODR_OK);
    EXPECT(set_u16(0x2000U, 0U, 78U), ODR_UNSUPP_ACCESS);
    /* Where there are no rules, it is the only one. */
    EXPECT(OD_extendBehind(OD_ENTRY_H200B, &own), ODR_OK);
    EXPECT(OD_ENTRY_H200B->extension == &own, 1);
    EXPECT(OD_extendBehind(NULL, &own), ODR_IDX_NOT_EXIST);

    /* Each object that a TPDO can carry has flags of its own; the others share an extension. */
    EXPECT(OD_ENTRY_H2001->extension == OD_ENTRY_H2002->extension, 1);
    EXPECT(OD_ENTRY_H200E->extension != OD_ENTRY_H200F->extension, 1);
    EXPECT(sizeof(OD_ENTRY_H200E->extension->flagsPDO), 6);
    (void)memset(OD_ENTRY_H200E->extension->flagsPDO, 0xFF, OD_FLAGS_PDO_SIZE);
    (void)memset(OD_ENTRY_H200F->extension->flagsPDO, 0xFF, OD_FLAGS_PDO_SIZE);
    OD_requestTPDO(OD_ENTRY_H200E, 0U);
    EXPECT(OD_ENTRY_H200E->extension->flagsPDO[0], 0xFE);
    EXPECT(OD_ENTRY_H200F->extension->flagsPDO[0], 0xFF);
    (void)memset(OD_ENTRY_H2010->extension->flagsPDO, 0xFF, OD_FLAGS_PDO_SIZE);
    OD_requestTPDO(OD_ENTRY_H2010, 40U);
    EXPECT(OD_ENTRY_H2010->extension->flagsPDO[5], 0xFE);
    /* With rules or without, they read and write as before. */
    OD_RAM.x200E_measured = 12U;
    EXPECT(get_u16(0x200EU, 0U), 12);
    EXPECT(set_u16(0x200FU, 0U, 10U), ODR_VALUE_HIGH);
    EXPECT(set_u16(0x200FU, 0U, 9U), ODR_OK);
    counts.reads = 0U;
    EXPECT(OD_extendBehind(OD_ENTRY_H200F, &own), ODR_OK);
    EXPECT(OD_ENTRY_H200F->extension != &own, 1);
    EXPECT(get_u16(0x200FU, 0U), 9);
    EXPECT(counts.reads, 1);
    EXPECT(set_u16(0x200FU, 0U, 10U), ODR_VALUE_HIGH);

    /* The original is written without any question. */
    EXPECT(OD_getSub(OD_find(OD, 0x2000U), 0U, &io, true), ODR_OK);
    word = 60000U;
    EXPECT(io.write(&io.stream, &word, 2U, &done), ODR_OK);
    EXPECT(OD_RAM.x2000_set_point, 60000);

    /* The node-ID, also a later one; what was changed stays. */
    EXPECT(OD_addNodeId(0U), ODR_INVALID_VALUE);
    EXPECT(OD_addNodeId(128U), ODR_INVALID_VALUE);
    EXPECT(OD_RAM.x200A_identifier, 0x700);
    EXPECT(OD_addNodeId(5U), ODR_OK);
    EXPECT(OD_RAM.x200A_identifier, 0x705);
    EXPECT(OD_addNodeId(5U), ODR_OK);
    EXPECT(OD_RAM.x200A_identifier, 0x705);
    EXPECT(OD_addNodeId(6U), ODR_OK);
    EXPECT(OD_RAM.x200A_identifier, 0x706);
    OD_RAM.x200A_identifier = 0x123U;
    EXPECT(OD_addNodeId(7U), ODR_OK);
    EXPECT(OD_RAM.x200A_identifier, 0x123);

    /* A command is refused until the stack's storage has the object. */
    EXPECT(set(0x1010U, 1U, "save", 4U), ODR_DATA_TRANSF);
    EXPECT(set(0x1011U, 1U, "load", 4U), ODR_DATA_TRANSF);
    EXPECT(get_u32(0x1010U, 1U), 1);
    own.write = OD_writeOriginal;
    EXPECT(OD_extension_init(OD_ENTRY_H1010, &own), ODR_OK);
    OD_extendAll(is_unlocked);
    EXPECT(OD_ENTRY_H1010->extension == &own, 1);

    /* Storage: what 1010h.2 and .3 store; 1010h.4 stores nothing. */
    EXPECT(sizeof(storage) / sizeof(storage[0]), 3);
    EXPECT((storage[0].addr == &OD_PERSIST_COMM) && (storage[0].subIndexOD == 2U) && (storage[0].attr == 5U), 1);
    EXPECT((storage[1].addr == &OD_PERSIST_APP) && (storage[1].len == sizeof(OD_PERSIST_APP)), 1);
    EXPECT((storage[1].subIndexOD == 3U) && (storage[1].attr == 5U), 1);
    EXPECT((storage[2].addr == &OD_PERSIST_AUTO) && (storage[2].attr == 2U), 1);
    EXPECT((get_u32(0x1010U, 1U) == 1U) && (get_u32(0x1010U, 2U) == 1U) && (get_u32(0x1010U, 3U) == 1U), 1);
    EXPECT((get_u32(0x1010U, 4U) == 0U) && (get_u32(0x1011U, 3U) == 1U), 1);
    EXPECT(strcmp(with_file[0].filename, "app"), 0);
    EXPECT((OD_PERSIST_APP.x200C_kept.first == 1) && (OD_RAM.x200C_kept.second == 2), 1);

    if (failures == 0U) {
        (void)printf("done\n");
    }
    return (failures == 0U) ? 0 : 1;
}
