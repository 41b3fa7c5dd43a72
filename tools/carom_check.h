/* carom devices --check: whether a device gives the right bits.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_CHECK_H
#define CAROM_CHECK_H

#include "carom_tool.h"

/* Checks the device that the options choose, and prints what it finds, after `print_device`; the exit code is 0 only if all is right. */
int check_device(const struct common_options *options, void (*print_device)(const carom_device_info *device));

/* How a device computes, seen from outside by what becomes of bodies that nothing hits, and of circles that hit. */
struct numbers_found {
	int count;      /* bodies that were watched */
	int quotients;  /* of so many as they should be */
	int contracted; /* products and sums of so many were rounded once instead of twice */
	bool denormals; /* they are kept, not made 0 */
	int hits;       /* so many pairs of circles were watched */
	int roots;      /* of so many the hit, which takes square roots, is the same on the CPU fallback */
};

/* carom_check_numbers.c; `def` chooses the device and the storage. */
carom_status find_numbers(const carom_world_def *def, struct numbers_found *found, carom_error *error);

#endif
