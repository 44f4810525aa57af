/* Prints what a generated dictionary holds, an object and an entry a line:
 *     object 1018 3 5
 *     entry 1018 1 41 4 9A 02 00 00
 * index, kind and number of entries; index, sub-index, attributes, length and bytes, `-` where nothing lies in memory. */
#include <stdio.h>

#include "301/CO_ODinterface.h"
#include "OD.h"

static void print_entry(const OD_entry_t *entry, uint8_t sub) {
    OD_IO_t io;
    const uint8_t *bytes;
    OD_size_t at;

    if (OD_getSub(entry, sub, &io, true) != ODR_OK) {
        return;
    }
    (void)printf("entry %04X %u %02X %lu", (unsigned)entry->index, (unsigned)sub, (unsigned)io.stream.attribute,
                 (unsigned long)io.stream.dataLength);
    bytes = (const uint8_t *)io.stream.dataOrig;
    if (bytes == NULL) {
        (void)printf(" -");
    } else {
        for (at = 0U; at < io.stream.dataLength; at++) {
            (void)printf(" %02X", (unsigned)bytes[at]);
        }
    }
    (void)printf("\n");
}

int main(void) {
    uint16_t at;
    unsigned sub;

    for (at = 0U; OD->list[at].index != 0U; at++) {
        OD_entry_t *const entry = OD_find(OD, OD->list[at].index);
        if (entry != &OD->list[at]) {
            (void)printf("not found: %04X\n", (unsigned)OD->list[at].index);
            return 1;
        }
        (void)printf("object %04X %u %u\n", (unsigned)entry->index, (unsigned)entry->odObjectType, (unsigned)entry->subEntriesCount);
        for (sub = 0U; sub <= 255U; sub++) {
            print_entry(entry, (uint8_t)sub);
        }
    }
    return (at == OD->size) ? 0 : 1;
}
