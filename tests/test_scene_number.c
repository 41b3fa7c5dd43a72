/* Numbers as text and back are what printf and strtod make of them, to the bit.
 * SPDX-License-Identifier: MIT */
#include "scenes.h"

#include "scene.h"

#define RANDOM_NUMBERS 200000

static uint64_t random_bits(uint64_t *state) /* SplitMix64 */
{
	uint64_t bits = *state += 0x9E3779B97F4A7C15u;
	bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9u;
	bits = (bits ^ bits >> 27) * 0x94D049BB133111EBu;
	return bits ^ bits >> 31;
}

static void check_read(const char *text, size_t length)
{
	double number = 0, wanted = strtod(text, NULL);
	const char *end = scene_scan_number(text, text + length, &number);
	if (end && (end != text + length || memcmp(&number, &wanted, sizeof number) != 0))
		fail_msg("%s is read as %a, strtod says %a", text, number, wanted);
}

static void check_number(float number)
{
	char text[SCENE_NUMBER_SIZE + 1], wanted[SCENE_NUMBER_SIZE];
	size_t length = scene_format_number(number, text);
	text[length] = '\0';
	snprintf(wanted, sizeof wanted, number != 0 ? "%.9g" : signbit(number) ? "-0.0" : "0", (double)number);
	if (strcmp(text, wanted) != 0)
		fail_msg("%a is written as %s, printf says %s", (double)number, text, wanted);
	check_read(text, length);
}

static float float_of(uint32_t bits)
{
	float number;
	memcpy(&number, &bits, sizeof number);
	return number;
}

static void random_floats_are_written_as_by_printf(void **state)
{
	uint64_t seed = 1;
	(void)state;
	for (int k = 0; k < RANDOM_NUMBERS; k++) {
		uint64_t bits = random_bits(&seed);
		float any = float_of((uint32_t)bits), usual = (float)((double)(int64_t)bits * 0x1p-63) * (float)(1u << (bits >> 32 & 31));
		if (isfinite(any))
			check_number(any);
		check_number(usual);
	}
}

/* Where a digit more or less is to be written, and where it is rounded from a tie. */
static void floats_at_the_edges_are_written_as_by_printf(void **state)
{
	static const float edges[] = {0, -0.0f, 1e-45f, 1.17549435e-38f, 3.40282347e38f, 0.5f, 1, 16777216, 33554432, 4194304.25f, 4194305.25f,
		2097152.125f, 2097152.375f, 999999936, 1e9f, 123456792, 0.1f, 0.000100000005f};
	(void)state;
	for (size_t k = 0; k < COUNT(edges); k++) {
		check_number(edges[k]);
		check_number(-edges[k]);
	}
	for (int ten = -45; ten <= 38; ten++) {
		float power = strtof((char[8]){'1', 'e', ten < 0 ? '-' : '+', (char)('0' + abs(ten) / 10), (char)('0' + abs(ten) % 10)}, NULL);
		check_number(nextafterf(power, 0));
		check_number(power);
		check_number(nextafterf(power, INFINITY));
	}
}

static size_t put_digits(char *text, uint64_t *seed, int most)
{
	size_t length = 1 + (size_t)(random_bits(seed) % (uint64_t)most);
	for (size_t k = 0; k < length; k++)
		text[k] = (char)('0' + random_bits(seed) % 10);
	return length;
}

static void random_texts_are_read_as_by_strtod(void **state)
{
	uint64_t seed = 2;
	(void)state;
	for (int k = 0; k < RANDOM_NUMBERS; k++) {
		char text[80] = "";
		uint64_t kind = random_bits(&seed);
		size_t length = 0;
		if (kind & 1)
			text[length++] = '-';
		if (kind & 2) {
			text[length++] = '0';
		} else {
			text[length] = (char)('1' + random_bits(&seed) % 9);
			length += 1 + put_digits(text + length + 1, &seed, kind & 4 ? 8 : 24);
		}
		if (kind & 8) {
			text[length++] = '.';
			length += put_digits(text + length, &seed, kind & 16 ? 8 : 30);
		}
		if (kind & 32) {
			text[length++] = kind & 64 ? 'e' : 'E';
			if (kind & 128)
				text[length++] = kind & 256 ? '+' : '-';
			length += put_digits(text + length, &seed, 2);
		}
		check_read(text, length);
	}
}

static void plain_numbers_are_read_at_once(void **state)
{
	static const char *const plain[] = {"0", "-0", "-0.0", "1", "-12.5", "1814.98523", "3.81469727e-06", "123456789e+13", "0.10", "9007199254740992"};
	double number;
	(void)state;
	for (size_t k = 0; k < COUNT(plain); k++) {
		if (scene_scan_number(plain[k], plain[k] + strlen(plain[k]), &number) != plain[k] + strlen(plain[k]))
			fail_msg("%s is not read", plain[k]);
		check_read(plain[k], strlen(plain[k]));
	}
}

static void what_is_no_json_number_is_not_read(void **state)
{
	static const char *const wrong[] = {"", "-", "+1", ".5", "1.", "1.e3", "01", "-01", "00", "1e", "1e+", "1E-", "e3", "nan", "inf", "-.5",
		"9007199254740993", "18446744073709551617", "1.00000000000000000000", "1e23", "1e-23", "1e9999"};
	double number;
	(void)state;
	for (size_t k = 0; k < COUNT(wrong); k++) {
		if (scene_scan_number(wrong[k], wrong[k] + strlen(wrong[k]), &number))
			fail_msg("%s is read", wrong[k]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(random_floats_are_written_as_by_printf),
		cmocka_unit_test(floats_at_the_edges_are_written_as_by_printf), cmocka_unit_test(random_texts_are_read_as_by_strtod),
		cmocka_unit_test(plain_numbers_are_read_at_once), cmocka_unit_test(what_is_no_json_number_is_not_read)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
