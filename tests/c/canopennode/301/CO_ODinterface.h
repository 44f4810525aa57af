/*
 * The interface that generated files of `odgen build --c canopennode` are written for, as far as they and the tests need it: types, members, numbers
 * and the behaviour of the accesses are those of CANopenNode v4; the text is not.
 */
#ifndef TESTS_CO_OD_INTERFACE_H
#define TESTS_CO_OD_INTERFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "301/CO_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a driver of the stack defines. */
typedef uint_fast8_t bool_t;
typedef float float32_t;
typedef double float64_t;

typedef uint32_t OD_size_t;
typedef uint8_t OD_attr_t;

#ifndef OD_FLAGS_PDO_SIZE
#define OD_FLAGS_PDO_SIZE 4U
#endif
#define CO_PROGMEM const

/* Attributes of an entry. */
typedef enum {
    ODA_SDO_R = 0x01,
    ODA_SDO_W = 0x02,
    ODA_SDO_RW = 0x03,
    ODA_TPDO = 0x04,
    ODA_RPDO = 0x08,
    ODA_TRPDO = 0x0C,
    ODA_TSRDO = 0x10,
    ODA_RSRDO = 0x20,
    ODA_TRSRDO = 0x30,
    ODA_MB = 0x40,
    ODA_STR = 0x80
} OD_attributes_t;

/* How an access ends. */
typedef enum {
    ODR_PARTIAL = -1,
    ODR_OK = 0,
    ODR_OUT_OF_MEM = 1,
    ODR_UNSUPP_ACCESS = 2,
    ODR_WRITEONLY = 3,
    ODR_READONLY = 4,
    ODR_IDX_NOT_EXIST = 5,
    ODR_NO_MAP = 6,
    ODR_MAP_LEN = 7,
    ODR_PAR_INCOMPAT = 8,
    ODR_DEV_INCOMPAT = 9,
    ODR_HW = 10,
    ODR_TYPE_MISMATCH = 11,
    ODR_DATA_LONG = 12,
    ODR_DATA_SHORT = 13,
    ODR_SUB_NOT_EXIST = 14,
    ODR_INVALID_VALUE = 15,
    ODR_VALUE_HIGH = 16,
    ODR_VALUE_LOW = 17,
    ODR_MAX_LESS_MIN = 18,
    ODR_NO_RESOURCE = 19,
    ODR_GENERAL = 20,
    ODR_DATA_TRANSF = 21,
    ODR_DATA_LOC_CTRL = 22,
    ODR_DATA_DEV_STATE = 23,
    ODR_OD_MISSING = 24,
    ODR_NO_DATA = 25,
    ODR_COUNT = 26
} ODR_t;

/* One access, which may take several calls. */
typedef struct {
    void *dataOrig;
    void *object;
    OD_size_t dataLength;
    OD_size_t dataOffset;
    OD_attr_t attribute;
    uint16_t index;
    uint8_t subIndex;
} OD_stream_t;

typedef struct {
    OD_stream_t stream;
    ODR_t (*read)(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead);
    ODR_t (*write)(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten);
} OD_IO_t;

typedef struct {
    void *object;
    ODR_t (*read)(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead);
    ODR_t (*write)(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten);
#if OD_FLAGS_PDO_SIZE > 0
    uint8_t flagsPDO[OD_FLAGS_PDO_SIZE];
#endif
} OD_extension_t;

typedef struct {
    uint16_t index;
    uint8_t subEntriesCount;
    uint8_t odObjectType;
    CO_PROGMEM void *odObject;
    OD_extension_t *extension;
} OD_entry_t;

typedef struct {
    uint16_t size;
    OD_entry_t *list;
} OD_t;

ODR_t OD_readOriginal(OD_stream_t *stream, void *buf, OD_size_t count, OD_size_t *countRead);
ODR_t OD_writeOriginal(OD_stream_t *stream, const void *buf, OD_size_t count, OD_size_t *countWritten);
OD_entry_t *OD_find(OD_t *od, uint16_t index);
ODR_t OD_getSub(const OD_entry_t *entry, uint8_t subIndex, OD_IO_t *io, bool_t odOrig);
uint32_t OD_getSDOabCode(ODR_t returnCode);

static inline ODR_t OD_extension_init(OD_entry_t *entry, OD_extension_t *extension) {
    if (entry == NULL) {
        return ODR_IDX_NOT_EXIST;
    }
    entry->extension = extension;
    return ODR_OK;
}

/* A bit for each sub-index: 0 asks for the TPDOs that map the entry, 1 says that they were sent. */
static inline void OD_requestTPDO(OD_entry_t *entry, uint8_t subIndex) {
#if OD_FLAGS_PDO_SIZE > 0
    if ((entry != NULL) && (entry->extension != NULL) && (subIndex < (OD_FLAGS_PDO_SIZE * 8U))) {
        entry->extension->flagsPDO[subIndex >> 3U] &= (uint8_t)~(1U << (subIndex & 7U));
    }
#else
    (void)entry;
    (void)subIndex;
#endif
}

#ifdef OD_DEFINITION
/* Objects, for the file that defines a dictionary. */
typedef enum { ODT_VAR = 1, ODT_ARR = 2, ODT_REC = 3, ODT_TYPE_MASK = 0x0F } OD_objectTypes_t;

typedef struct {
    void *dataOrig;
    OD_attr_t attribute;
    OD_size_t dataLength;
} OD_obj_var_t;

typedef struct {
    uint8_t *dataOrig0;
    void *dataOrig;
    OD_attr_t attribute0;
    OD_attr_t attribute;
    OD_size_t dataElementLength;
    OD_size_t dataElementSizeof;
} OD_obj_array_t;

typedef struct {
    void *dataOrig;
    uint8_t subIndex;
    OD_attr_t attribute;
    OD_size_t dataLength;
} OD_obj_record_t;
#endif

#ifdef __cplusplus
}
#endif

#endif
