// The headers can be read by C++.
#include "301/CO_ODinterface.h"
#include HEADER
#include EXTENSION
#include "OD_types.h"

int main() {
    return (DICTIONARY->size > 0U) ? 0 : 1;
}
