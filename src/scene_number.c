/* Numbers as text and back, where whole numbers of 64 bits can do it exactly; printf and strtod do the rest.
 * SPDX-License-Identifier: MIT */
#include "scene.h"

#include <math.h>
#include <string.h>

#define DIGITS 9       /* they tell every float from its neighbours */
#define MOST_DIGITS 19 /* that any 64-bit number has room for; a point may be one of them */
#define EXACT_TENS 22  /* 10^22 is the last power of ten that is a double */

/* ---- To text */

/* Without a locale's comma, or whatever else it has for a point. */
static size_t format_by_printf(float number, char *text)
{
	int length = snprintf(text, SCENE_NUMBER_SIZE, "%.*g", DIGITS, (double)number);
	size_t kept = 0;
	for (int k = 0; k < length; k++) {
		if (strchr("0123456789+-e", text[k]))
			text[kept++] = text[k];
		else if (kept == 0 || text[kept - 1] != '.') /* one point for what may be several bytes */
			text[kept++] = '.';
	}
	text[kept] = 0;
	return kept;
}

/* The digits of `number`, which is above 10^-4 and below 10^9: rounded(number * 10^(8 - *decade)), 10^8 <= it < 10^9. The
 * product of its 24 bits and at most 10^12 is below 2^64, so that nothing is lost before the rounding, half to even as
 * printf's. 0 where rounding leads out of the range. */
static uint64_t nine_digits(float number, int *decade)
{
	static const double bounds[] = {1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
	static const uint64_t tens[] = {
		1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000, 10000000000u, 100000000000u, 1000000000000u};
	uint32_t bits;
	int place = 0;
	memcpy(&bits, &number, sizeof bits);
	while (place < 12 && (double)number >= bounds[place])
		place++;
	int shift = 150 - (int)(bits >> 23); /* number = its 24 bits / 2^shift; at most 37 */
	uint64_t product = ((bits & 0x7FFFFF) | 0x800000) * tens[12 - place], digits = product;
	if (shift > 0) {
		uint64_t rest = product & ((UINT64_C(1) << shift) - 1), half = UINT64_C(1) << (shift - 1);
		digits = product >> shift;
		digits += rest > half || (rest == half && digits & 1);
	} else {
		digits <<= -shift;
	}
	*decade = place - 4;
	return digits >= tens[8] && digits < tens[9] ? digits : 0;
}

/* As %g does: no zeros at the end of a fraction. */
static size_t put_digits(uint64_t digits, int decade, char *text)
{
	char all[DIGITS], *at = text;
	int count = DIGITS, before = decade >= 0 ? decade + 1 : 0;
	for (int k = DIGITS; k-- > 0; digits /= 10)
		all[k] = (char)('0' + digits % 10);
	while (count > before && all[count - 1] == '0')
		count--;
	if (before == 0)
		*at++ = '0';
	memcpy(at, all, (size_t)before);
	at += before;
	if (count > before) {
		*at++ = '.';
		for (int k = -1; k > decade; k--)
			*at++ = '0';
		memcpy(at, all + before, (size_t)(count - before));
		at += count - before;
	}
	return (size_t)(at - text);
}

size_t scene_format_number(float number, char *text)
{
	float magnitude = fabsf(number);
	int decade;
	uint64_t digits = magnitude > 1e-4f && magnitude < 1e9f ? nine_digits(magnitude, &decade) : 0;
	size_t sign = signbit(number) ? 1 : 0;
	if (digits) {
		*text = '-';
		return sign + put_digits(digits, decade, text + sign);
	}
	if (number != 0)
		return format_by_printf(number, text);
	memcpy(text, "-0.0", 4); /* -0 is an integer to many a reader, its sign lost */
	*text = sign ? '-' : '0';
	return sign ? 4 : 1;
}

/* ---- From text */

static bool is_digit(char character)
{
	return character >= '0' && character <= '9';
}

/* Appends the digits at `at` to *digits, which holds any 19. */
static const char *scan_digits(const char *at, const char *end, uint64_t *digits)
{
	for (; at < end && is_digit(*at); at++)
		*digits = *digits * 10 + (uint64_t)(*at - '0');
	return at;
}

/* "e-5", or nothing. */
static const char *scan_exponent(const char *at, const char *end, int *exponent)
{
	uint64_t digits = 0;
	bool negative;
	if (at == end || (*at != 'e' && *at != 'E'))
		return at;
	at++;
	negative = at < end && *at == '-';
	if (at < end && (*at == '-' || *at == '+'))
		at++;
	const char *first = at;
	at = scan_digits(at, end, &digits);
	if (at == first || at - first > 3)
		return NULL;
	*exponent += negative ? -(int)digits : (int)digits;
	return at;
}

/* Clinger (1990): digits below 2^53 and a power of ten up to 10^22 are doubles, so that their product or quotient, rounded
 * once, is what strtod gives. */
const char *scene_scan_number(const char *at, const char *end, double *number)
{
	static const double tens[] = {
		1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
	uint64_t digits = 0;
	int exponent = 0;
	bool negative = at < end && *at == '-';
	const char *first = negative ? at + 1 : at;
	at = scan_digits(first, end, &digits);
	if (at == first || (at - first > 1 && *first == '0'))
		return NULL;
	if (at < end && *at == '.') {
		const char *fraction = at + 1;
		at = scan_digits(fraction, end, &digits);
		if (at == fraction)
			return NULL;
		exponent = -(int)(at - fraction);
	}
	if (at - first > MOST_DIGITS)
		return NULL;
	at = scan_exponent(at, end, &exponent);
	if (!at || digits > UINT64_C(1) << 53 || exponent < -EXACT_TENS || exponent > EXACT_TENS)
		return NULL;
	double magnitude = exponent < 0 ? (double)digits / tens[-exponent] : (double)digits * tens[exponent];
	*number = negative ? -magnitude : magnitude;
	return at;
}
