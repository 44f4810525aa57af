/*
 * What the main program of `odgen new --firmware canopennode` takes from the stack: names, types and numbers are those of CANopenNode v4; the text is
 * not.
 */
#ifndef TESTS_CANOPEN_H
#define TESTS_CANOPEN_H

#include "301/CO_ODinterface.h"

#define CO_CONFIG_LSS_SLAVE 0x01
#ifndef CO_CONFIG_LSS
#define CO_CONFIG_LSS CO_CONFIG_LSS_SLAVE
#endif
#ifndef CO_CONFIG_SYNC
#define CO_CONFIG_SYNC (CO_CONFIG_SYNC_ENABLE | CO_CONFIG_SYNC_PRODUCER)
#endif
#ifndef CO_CONFIG_PDO
#define CO_CONFIG_PDO (CO_CONFIG_RPDO_ENABLE | CO_CONFIG_TPDO_ENABLE)
#endif

#define CO_NMT_STARTUP_TO_OPERATIONAL 0x0100U

typedef enum { CO_ERROR_NO = 0, CO_ERROR_ILLEGAL_ARGUMENT = -1 } CO_ReturnError_t;
typedef enum { CO_RESET_NOT = 0, CO_RESET_COMM = 1, CO_RESET_APP = 2, CO_RESET_QUIT = 3 } CO_NMT_reset_cmd_t;

typedef union {
    uint32_t addr[4];
    struct {
        uint32_t vendorID;
        uint32_t productCode;
        uint32_t revisionNumber;
        uint32_t serialNumber;
    } identity;
} CO_LSS_address_t;

typedef struct {
    volatile bool_t CANnormal;
} CO_CANmodule_t;

typedef struct CO_config CO_config_t;
typedef struct CO_NMT CO_NMT_t;
typedef struct CO_EM CO_EM_t;

typedef struct {
    CO_CANmodule_t *CANmodule;
    CO_EM_t *em;
} CO_t;

ODR_t OD_get_u32(const OD_entry_t *entry, uint8_t subIndex, uint32_t *val, bool_t odOrig);

void CO_CANsetConfigurationMode(void *CANptr);
void CO_CANsetNormalMode(CO_CANmodule_t *CANmodule);

CO_t *CO_new(CO_config_t *config, uint32_t *heapMemoryUsed);
CO_ReturnError_t CO_CANinit(CO_t *co, void *CANptr, uint16_t bitRate);
CO_ReturnError_t CO_LSSinit(CO_t *co, CO_LSS_address_t *lssAddress, uint8_t *pendingNodeID, uint16_t *pendingBitRate);
CO_ReturnError_t CO_CANopenInit(
    CO_t *co,
    CO_NMT_t *NMT,
    CO_EM_t *em,
    OD_t *od,
    OD_entry_t *OD_statusBits,
    uint16_t NMTcontrol,
    uint16_t firstHBTime_ms,
    uint16_t SDOserverTimeoutTime_ms,
    uint16_t SDOclientTimeoutTime_ms,
    bool_t SDOclientBlockTransfer,
    uint8_t nodeId,
    uint32_t *errInfo);
CO_ReturnError_t CO_CANopenInitPDO(CO_t *co, CO_EM_t *em, OD_t *od, uint8_t nodeId, uint32_t *errInfo);
CO_NMT_reset_cmd_t CO_process(CO_t *co, bool_t enableGateway, uint32_t timeDifference_us, uint32_t *timerNext_us);
bool_t CO_process_SYNC(CO_t *co, uint32_t timeDifference_us, uint32_t *timerNext_us);
void CO_process_RPDO(CO_t *co, bool_t syncWas, uint32_t timeDifference_us, uint32_t *timerNext_us);
void CO_process_TPDO(CO_t *co, bool_t syncWas, uint32_t timeDifference_us, uint32_t *timerNext_us);

#endif
