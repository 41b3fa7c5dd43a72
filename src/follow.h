/* Where the names of files lead.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_FOLLOW_H
#define CAROM_FOLLOW_H

#include <limits.h>
#include <stdbool.h>

typedef struct carom_target {
	char path[PATH_MAX]; /* symbolic links followed, also to what is not there yet */
	int descriptor;      /* of this process, where the name stands for one, as /dev/stdout does; else -1 */
} carom_target;

/* False, with errno set, if it leads nowhere: a folder is missing, or links lead round and round. */
bool carom_follow(const char *name, carom_target *target);

/* Another descriptor of the same open file, with the same place in it; -1, with errno set, if it is closed or of the mode `refused`, O_RDONLY or
 * O_WRONLY. */
int carom_duplicate(int descriptor, int refused);

#endif
