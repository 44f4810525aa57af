/*
 * A Cortex-M that asks a dictionary what was asked on the host, and compares the answers. No library: what the compiler calls is
 * here, too. It reports the result to the host by semihosting.
 */
#include "answer.h"

/** Requests and their answers in turn, each after its length in 4 bytes. */
extern const uint8_t exchange[];
extern const uint8_t exchange_end[];

/** The end of the RAM, and what has to be 0. */
extern uint8_t stack_top[];
extern uint8_t bss_start[];
extern uint8_t bss_end[];

/* What compilers call. */

void *memset(void *place, int value, size_t length);
void *memcpy(void *place, const void *from, size_t length);
void __aeabi_memclr(void *place, size_t length);
void __aeabi_memcpy(void *place, const void *from, size_t length);
uint64_t divided_count(uint64_t number, uint64_t divisor, uint64_t *rest);
int64_t divided(int64_t number, int64_t divisor, int64_t *rest);
void __aeabi_ldivmod(void);
void __aeabi_uldivmod(void);
void reset(void);

void *memset(void *place, int value, size_t length)
{
    volatile uint8_t *bytes = place;
    size_t at;
    for (at = 0U; at < length; at++) {
        bytes[at] = (uint8_t)value;
    }
    return place;
}

void *memcpy(void *place, const void *from, size_t length)
{
    volatile uint8_t *bytes = place;
    const uint8_t *other = from;
    size_t at;
    for (at = 0U; at < length; at++) {
        bytes[at] = other[at];
    }
    return place;
}

void __aeabi_memclr(void *place, size_t length)
{
    (void)memset(place, 0, length);
}

void __aeabi_memcpy(void *place, const void *from, size_t length)
{
    (void)memcpy(place, from, length);
}

/** Divides bit by bit. */
uint64_t divided_count(uint64_t number, uint64_t divisor, uint64_t *rest)
{
    uint64_t quotient = 0U;
    uint64_t remainder = 0U;
    int bit;
    for (bit = 63; bit >= 0; bit--) {
        remainder = (remainder << 1) | ((number >> bit) & 1U);
        if (remainder >= divisor) {
            remainder -= divisor;
            quotient |= (uint64_t)1U << bit;
        }
    }
    *rest = remainder;
    return quotient;
}

/** Divides, and rounds towards 0. */
int64_t divided(int64_t number, int64_t divisor, int64_t *rest)
{
    uint64_t by = (divisor < 0) ? (0U - (uint64_t)divisor) : (uint64_t)divisor;
    uint64_t remainder;
    uint64_t quotient = divided_count((number < 0) ? (0U - (uint64_t)number) : (uint64_t)number, by, &remainder);
    *rest = (number < 0) ? (int64_t)(0U - remainder) : (int64_t)remainder;
    return ((number < 0) != (divisor < 0)) ? (int64_t)(0U - quotient) : (int64_t)quotient;
}

/* The quotient in r0 and r1, the rest in r2 and r3. */
#define DIVISION(name, function)                 \
    __attribute__((naked)) void name(void)       \
    {                                            \
        __asm volatile("push {r6, lr}\n"         \
                       "sub sp, #16\n"           \
                       "add r6, sp, #8\n"        \
                       "str r6, [sp]\n"          \
                       "bl " function "\n"       \
                       "ldr r2, [sp, #8]\n"      \
                       "ldr r3, [sp, #12]\n"     \
                       "add sp, #16\n"           \
                       "pop {r6, pc}");          \
    }

DIVISION(__aeabi_ldivmod, "divided")
DIVISION(__aeabi_uldivmod, "divided_count")

/* Semihosting. */

static void call_host(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

static void tell(const char *text)
{
    call_host(0x04U, text);
}

static void tell_number(uint32_t number)
{
    char digits[12];
    size_t at = sizeof(digits) - 1U;
    digits[at] = '\0';
    do {
        at--;
        digits[at] = (char)('0' + (char)(number % 10U));
        number /= 10U;
    } while (number > 0U);
    tell(&digits[at]);
}

static void end(uint32_t reason)
{
    for (;;) {
        call_host(0x18U, (const void *)(uintptr_t)reason);
    }
}

/* The comparison. */

static uint32_t length_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | ((uint32_t)bytes[1] << 8) | ((uint32_t)bytes[2] << 16) | ((uint32_t)bytes[3] << 24);
}

static uint8_t found[LONGEST_ANSWER];

void reset(void)
{
    const uint8_t *at = exchange;
    uint32_t count = 0U;
    (void)memset(bss_start, 0, (size_t)(bss_end - bss_start));
    while (at < exchange_end) {
        const uint8_t *request = &at[4];
        uint32_t length = length_at(at);
        const uint8_t *expected = &request[length + 4U];
        uint32_t expected_length = length_at(&request[length]);
        size_t byte;
        size_t found_length = answer(request, length, found);
        for (byte = 0U; (found_length == expected_length) && (byte < found_length); byte++) {
            if (found[byte] != expected[byte]) {
                found_length = 0U;
            }
        }
        if (found_length != expected_length) {
            tell("another answer to request ");
            tell_number(count);
            tell("\n");
            end(0x20024U);
        }
        at = &expected[expected_length];
        count++;
    }
    tell_number(count);
    tell(" requests\n");
    end((count > 0U) ? 0x20026U : 0x20024U);
}

/** Stack and first instruction; everything else would be a fault, which the timeout reports. */
__attribute__((section(".vectors"), used)) static void *const vectors[] = {stack_top, (void *)reset};
