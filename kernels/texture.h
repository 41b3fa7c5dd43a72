/* Texels by name. Every texture has two bodies, image2d and buffer; which one is chosen when the program is built, and
 * both hold the same rows. A kernel takes textures as TEX_IN(name) and TEX_OUT(name) (BYTES_IN and BYTES_OUT for the
 * textures of bytes), hands them on as TEX(name), and reads and writes whole texels. Where reads are counted, for the
 * tests of section 2.2's numbers, each texture brings the counter along. */
#define CHANNEL_OF(texel, channel) ((texel).s##channel)
#define CHANNEL(texel, channel) CHANNEL_OF(texel, channel)

#ifdef CAROM_COUNT_READS
#define COUNTER(t) , __global uint *t##_reads
#define COUNTED(t) , t##_reads
#define COUNT(t) atomic_inc(t##_reads),
#else
#define COUNTER(t)
#define COUNTED(t)
#define COUNT(t)
#endif

#ifdef CAROM_IMAGES
#define TEX_IN(t) read_only image2d_t t COUNTER(t)
#define TEX_OUT(t) write_only image2d_t t COUNTER(t)
#define BYTES_IN(t) read_only image2d_t t COUNTER(t)
#define BYTES_OUT(t) write_only image2d_t t COUNTER(t)
#define TEX(t) t COUNTED(t)
#define TEX_SENT(t, x, y) read_imagef(t, (int2)((x), (y)))
#define TEX_STORE(t, x, y, texel) write_imagef(t, (int2)((x), (y)), (texel))
#define BYTES_LOAD(t, x, y) (COUNT(t) read_imageui(t, (int2)((x), (y))))
#define BYTES_STORE(t, x, y, texel) write_imageui(t, (int2)((x), (y)), (texel))
#define WORD_STORE(t, x, y, word) write_imageui(t, (int2)((x), (y)), convert_uint4(as_uchar4(word)))
#define BYTES_STORE8(t, x, y, words)                                                                                   \
	{                                                                                                                  \
		WORD_STORE(t, (x), y, words.s0), WORD_STORE(t, (x) + 1, y, words.s1), WORD_STORE(t, (x) + 2, y, words.s2);     \
		WORD_STORE(t, (x) + 3, y, words.s3), WORD_STORE(t, (x) + 4, y, words.s4), WORD_STORE(t, (x) + 5, y, words.s5); \
		WORD_STORE(t, (x) + 6, y, words.s6), WORD_STORE(t, (x) + 7, y, words.s7);                                      \
	}
#else
#define TEX_IN(t) __global const float4 *restrict t, int t##_width COUNTER(t)
#define TEX_OUT(t) __global float4 *restrict t, int t##_width COUNTER(t)
#define BYTES_IN(t) __global const uchar4 *restrict t, int t##_width COUNTER(t)
#define BYTES_OUT(t) __global uchar4 *restrict t, int t##_width COUNTER(t)
#define TEX(t) t, t##_width COUNTED(t)
#define TEX_SENT(t, x, y) ((t)[(size_t)(y) * (size_t)(t##_width) + (size_t)(x)])
#define TEX_STORE(t, x, y, texel) ((t)[(size_t)(y) * (size_t)(t##_width) + (size_t)(x)] = (texel))
#define BYTES_LOAD(t, x, y) (COUNT(t) convert_uint4((t)[(size_t)(y) * (size_t)(t##_width) + (size_t)(x)]))
#define BYTES_STORE(t, x, y, texel) ((t)[(size_t)(y) * (size_t)(t##_width) + (size_t)(x)] = convert_uchar4(texel))
#define BYTES_STORE8(t, x, y, words) vstore8(words, 0, (__global uint *)((t) + (size_t)(y) * (size_t)(t##_width) + (size_t)(x)))
#endif

/* TEX_STREAM stores what a later kernel reads: past the caches where the compiler can, for they would first fetch what is overwritten, and have
 * dropped it, or keep it for another core, when it is read. */
#define TEX_STREAM(t, x, y, texel) TEX_STORE(t, x, y, texel)
#if defined(__has_builtin) && !defined(CAROM_IMAGES)
#if __has_builtin(__builtin_nontemporal_store)
#undef TEX_STREAM
#define TEX_STREAM(t, x, y, texel) __builtin_nontemporal_store(texel, (t) + (size_t)(y) * (size_t)(t##_width) + (size_t)(x))
#endif
#endif

/* Lists of ints are buffers on every device; what is LIST_OUT may be read, too. (Not restrict: Oclgrind lacks what that becomes when a function
 * is inlined.) */
#define LIST_IN(t) __global const int *t
#define LIST_OUT(t) __global int *t
/* Lists of two ints an entry. */
#define PAIRS_IN(t) __global const int2 *t
#define PAIRS_OUT(t) __global int2 *t
/* Records, four floats, likewise. */
#define RECORD_IN(t) __global const float4 *t
#define RECORD_OUT(t) __global float4 *t

/* FETCH brings what will be read soon into the caches: on CPUs, where all memory has one kind of address. */
#if defined(__has_builtin) && (defined(__x86_64__) || defined(__aarch64__))
#define FETCH(address) __builtin_prefetch((const void *)(size_t)(address))
#else
#define FETCH(address) (void)(address)
#endif

/* An int that other work-items may be changing atomically, read without waiting for them: what is found may be old, which costs time at most.
 * Where races are looked for (Oclgrind) the read is atomic, too, so that what is still reported is a mistake. */
#ifdef CAROM_CHECK_RACES
#define PEEK(list, i) atomic_or((volatile __global int *)(list) + (i), 0)
#else
#define PEEK(list, i) ((list)[i])
#endif

/* TEX_SENT reads what OpenGL would send with a draw call, as attributes of a vertex or as uniforms [3]: it is not counted. */
#define TEX_LOAD(t, x, y) (COUNT(t) TEX_SENT(t, x, y))

/* One texel a body, folded into rows. */
#define ROW_LOAD(t, i) TEX_LOAD(t, (i) & (ROW_SIZE - 1), (i) >> ROW_LOG2)
#define ROW_SENT(t, i) TEX_SENT(t, (i) & (ROW_SIZE - 1), (i) >> ROW_LOG2)
#define ROW_STORE(t, i, texel) TEX_STORE(t, (i) & (ROW_SIZE - 1), (i) >> ROW_LOG2, texel)
