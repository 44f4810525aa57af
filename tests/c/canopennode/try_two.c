/* Two dictionaries in one program, as an application with two nodes has them: the dictionaries are those of tests/tests/c/canopennode/extension.rs. */
#include <stdio.h>

#include "301/CO_ODinterface.h"
#include "ODA.h"
#include "ODA_extension.h"
#include "ODB.h"
#include "ODB_extension.h"

static bool_t is_unlocked(void) {
    return true;
}

static ODR_t set_u16(OD_t *od, uint16_t index, uint16_t value) {
    OD_IO_t io;
    OD_size_t written = 0U;
    const ODR_t outcome = OD_getSub(OD_find(od, index), 0U, &io, false);

    return (outcome == ODR_OK) ? io.write(&io.stream, &value, sizeof(value), &written) : outcome;
}

int main(void) {
    bool is_right = true;

    ODA_extendAll(NULL);
    ODB_extendAll(is_unlocked);
    /* The limits of each are kept, and each has its own values. */
    is_right = is_right && (set_u16(ODA, 0x2000U, 5000U) == ODR_VALUE_HIGH);
    is_right = is_right && (set_u16(ODB, 0x2000U, 5000U) == ODR_VALUE_HIGH);
    is_right = is_right && (set_u16(ODA, 0x2000U, 500U) == ODR_OK) && (set_u16(ODB, 0x2000U, 600U) == ODR_OK);
    is_right = is_right && (ODA_RAM.x2000_set_point == 500U) && (ODB_RAM.x2000_set_point == 600U);
    /* One is locked, the other one is not. */
    is_right = is_right && (set_u16(ODA, 0x2005U, 1U) == ODR_DATA_DEV_STATE);
    is_right = is_right && (set_u16(ODB, 0x2005U, 1U) == ODR_OK);
    /* Each has its node-ID. */
    is_right = is_right && (ODA_addNodeId(5U) == ODR_OK) && (ODB_addNodeId(6U) == ODR_OK);
    is_right = is_right && (ODA_RAM.x200A_identifier == 0x705U) && (ODB_RAM.x200A_identifier == 0x706U);
    is_right = is_right && (ODA_ENTRY_H2000->index == 0x2000U) && (ODB_ENTRY_H2000->extension != ODA_ENTRY_H2000->extension);
    (void)printf(is_right ? "done\n" : "wrong\n");
    return is_right ? 0 : 1;
}
