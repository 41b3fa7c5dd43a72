/* How many items an array has.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_COUNT_H
#define CAROM_TESTS_COUNT_H

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

#endif
