/* Tries a generated dictionary with the cases of a file (see tests/shared/cases.rs), as the stack's SDO server goes about it, and prints what each
 * gave, a line for a case: the abort code, and the bytes that are read then, if any; `changed` where a refused write changed something. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "301/CO_ODinterface.h"
#include "OD.h"
#include "OD_extension.h"

#define READ 0U
#define WRITE_UNLOCKED 2U
#define NODE 5U
/* The longest value of the devices that are tried. */
#define LONGEST 4000U

static bool_t unlocked = false;

static bool_t is_unlocked(void) {
    return unlocked;
}

/* All values, to be put back before each case. */
typedef struct {
    uint8_t *place;
    OD_size_t length;
    uint8_t bytes[LONGEST];
} kept_t;

static kept_t *kept = NULL;
static size_t kept_count = 0U;

static void keep_all(void) {
    uint16_t at;
    unsigned sub;

    for (at = 0U; at < OD->size; at++) {
        for (sub = 0U; sub <= 255U; sub++) {
            OD_IO_t io;
            if ((OD_getSub(&OD->list[at], (uint8_t)sub, &io, true) == ODR_OK) && (io.stream.dataOrig != NULL)) {
                if (io.stream.dataLength > LONGEST) {
                    exit(2);
                }
                kept = (kept_t *)realloc(kept, (kept_count + 1U) * sizeof(kept_t));
                if (kept == NULL) {
                    exit(2);
                }
                kept[kept_count].place = (uint8_t *)io.stream.dataOrig;
                kept[kept_count].length = io.stream.dataLength;
                (void)memcpy(kept[kept_count].bytes, io.stream.dataOrig, io.stream.dataLength);
                kept_count++;
            }
        }
    }
}

static void put_back(void) {
    size_t at;
    for (at = 0U; at < kept_count; at++) {
        (void)memcpy(kept[at].place, kept[at].bytes, kept[at].length);
    }
}

static bool is_as_before(void) {
    size_t at;
    for (at = 0U; at < kept_count; at++) {
        if (memcmp(kept[at].place, kept[at].bytes, kept[at].length) != 0) {
            return false;
        }
    }
    return true;
}

/* A text ends where it is ended; one of 16 bits is not among what the cases compare. */
static OD_size_t shown_length(const OD_stream_t *stream, const uint8_t *bytes, OD_size_t length) {
    OD_size_t at = 0U;
    if ((stream->attribute & (uint8_t)ODA_STR) == 0U) {
        return length;
    }
    while ((at < length) && (bytes[at] != 0U)) {
        at++;
    }
    return at;
}

static ODR_t read_value(uint16_t index, uint8_t sub, uint8_t *bytes, OD_size_t *length) {
    OD_IO_t io;
    ODR_t outcome = OD_getSub(OD_find(OD, index), sub, &io, false);
    if (outcome != ODR_OK) {
        return outcome;
    }
    if ((io.stream.attribute & (uint8_t)ODA_SDO_R) == 0U) {
        return ODR_WRITEONLY;
    }
    outcome = io.read(&io.stream, bytes, LONGEST, length);
    if (outcome == ODR_OK) {
        *length = shown_length(&io.stream, bytes, *length);
    }
    return outcome;
}

static ODR_t write_value(uint16_t index, uint8_t sub, const uint8_t *data, OD_size_t length) {
    OD_IO_t io;
    uint8_t padded[LONGEST] = {0U};
    OD_size_t written = 0U;
    ODR_t outcome = OD_getSub(OD_find(OD, index), sub, &io, false);
    if (outcome != ODR_OK) {
        return outcome;
    }
    if ((io.stream.attribute & (uint8_t)ODA_SDO_W) == 0U) {
        return ODR_READONLY;
    }
    /* The server looks at the length before it asks the extension; a DOMAIN has none. */
    if (io.stream.dataLength != 0U) {
        if (length > io.stream.dataLength) {
            return ODR_DATA_LONG;
        }
        if ((length < io.stream.dataLength) && ((io.stream.attribute & (uint8_t)ODA_STR) == 0U)) {
            return ODR_DATA_SHORT;
        }
    }
    (void)memcpy(padded, data, length);
    if (((io.stream.attribute & (uint8_t)ODA_STR) != 0U) && (length < io.stream.dataLength)) {
        /* The server ends a shorter text. */
        const OD_size_t rest = io.stream.dataLength - length;
        length += (rest > 2U) ? 2U : rest;
        io.stream.dataLength = length;
    }
    return io.write(&io.stream, padded, length, &written);
}

int main(int argc, char **argv) {
    static uint8_t cases[8U << 20U];
    size_t size;
    size_t at = 0U;
    FILE *file = (argc > 1) ? fopen(argv[1], "rb") : NULL;

    if (file == NULL) {
        return 2;
    }
    size = fread(cases, 1U, sizeof(cases), file);
    (void)fclose(file);
    if (size == sizeof(cases)) {
        return 2;
    }
    OD_extendAll(is_unlocked);
    if (OD_addNodeId(NODE) != ODR_OK) {
        return 2;
    }
    keep_all();
    while (at < size) {
        const uint8_t kind = cases[at];
        const uint16_t index = (uint16_t)(cases[at + 1U] | ((unsigned)cases[at + 2U] << 8U));
        const uint8_t sub = cases[at + 3U];
        const uint8_t length = cases[at + 4U];
        const uint8_t *const data = &cases[at + 5U];
        const uint8_t expected = cases[at + 5U + length + 4U];
        uint8_t bytes[LONGEST + 2U] = {0U};
        OD_size_t count = 0U;
        OD_size_t byte;
        ODR_t outcome = ODR_OK;
        bool is_changed = false;

        at += 5U + (size_t)length + 5U + ((expected == 0xFFU) ? 0U : (size_t)expected);
        put_back();
        unlocked = (kind == WRITE_UNLOCKED);
        if (kind != READ) {
            outcome = write_value(index, sub, data, length);
            is_changed = (outcome != ODR_OK) && !is_as_before();
        }
        if (outcome == ODR_OK) {
            const ODR_t read_outcome = read_value(index, sub, bytes, &count);
            if (kind == READ) {
                outcome = read_outcome;
            } else if (read_outcome != ODR_OK) {
                count = 0U;
            } else {
                /* Bytes to show. */
            }
        }
        (void)printf("%08lX", (unsigned long)OD_getSDOabCode(outcome));
        for (byte = 0U; byte < count; byte++) {
            (void)printf(" %02X", (unsigned)bytes[byte]);
        }
        (void)printf("%s\n", is_changed ? " changed" : "");
    }
    free(kept);
    return 0;
}
