/* Interruptions, SIGINT, SIGTERM and SIGHUP (its terminal is gone): the first ends the work after what is at hand, the second the process.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <signal.h>
#include <string.h>

/* Set by the handler, which can reach nothing but a global. */
static volatile sig_atomic_t interrupted;

static void on_signal(int number)
{
	interrupted = number;
}

/* What the caller ignores stays ignored. */
static void catch_signal(int number)
{
	struct sigaction action, before;
	memset(&action, 0, sizeof action);
	action.sa_handler = on_signal;
	action.sa_flags = (int)SA_RESETHAND | SA_RESTART;
	if (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
		sigaction(number, &action, NULL);
}

void catch_interruptions(void)
{
	catch_signal(SIGINT);
	catch_signal(SIGTERM);
	catch_signal(SIGHUP);
}

bool is_interrupted(void)
{
	return interrupted != 0;
}

int interrupted_code(int code)
{
	return interrupted ? 128 + (int)interrupted : code;
}

carom_status fail_interrupted(carom_error *error)
{
	return interrupted ? wrong(error, "interrupted: files are as they were before") : CAROM_OK;
}
