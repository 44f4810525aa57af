/* Prints the settings that a dictionary makes, without the flags for all services: `EM 0B`. */
#include <stdio.h>

#include "301/CO_ODinterface.h"
#include "OD.h"

#define PRINT(name) (void)printf("%s %02X\n", #name, (unsigned)((CO_CONFIG_##name) & 0xFFFU))

int main(void) {
    PRINT(HB_CONS);
    PRINT(NODE_GUARDING);
    PRINT(EM);
    PRINT(TIME);
    PRINT(SYNC);
    PRINT(PDO);
#ifdef CO_CONFIG_SDO_CLI
    PRINT(SDO_CLI);
    PRINT(FIFO);
#endif
#ifdef OD_ENTRY_H1006
    /* Read when it runs: a compiler knows that no element of a list is at NULL. */
    OD_entry_t *volatile period = OD_ENTRY_H1006;
    (void)printf("1006 %s\n", (period == NULL) ? "missing" : "there");
#endif
    return 0;
}
