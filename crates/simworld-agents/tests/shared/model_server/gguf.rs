//! A llama of random weights as a GGUF file of half a megabyte: it speaks nonsense, by the rules of any grammar.
//!
//! The format is llama.cpp's GGUF, version 3: <https://github.com/ggml-org/ggml/blob/master/docs/gguf.md>.

use simworld_core::seed::Seed;

const WIDE: u64 = 64;
const LAYERS: u32 = 2;
const HEADS: u32 = 4;
const FEED: u64 = 128;
const ALIGNMENT: usize = 32;

/// Pairs of tokens that are one token, in the order in which they are joined; `Ġ` stands for a space.
const MERGES: [(&str, &str); 16] = [
    ("Ġ", "t"),
    ("h", "e"),
    ("i", "n"),
    ("r", "e"),
    ("o", "n"),
    ("Ġt", "he"),
    ("e", "r"),
    ("Ġ", "a"),
    ("a", "t"),
    ("o", "u"),
    ("Ġ", "w"),
    ("e", "n"),
    ("in", "g"),
    ("i", "t"),
    ("o", "r"),
    ("Ġ", "s"),
];

/// The bytes of the file.
pub fn random_llama(seed: Seed) -> Vec<u8> {
    let tokens = tokens();
    let end = tokens.len() as u32 - 1;
    let mut head = Head::default();
    head.text("general.architecture", "llama");
    head.text("general.name", "random");
    head.number("llama.context_length", 2048);
    head.number("llama.embedding_length", WIDE as u32);
    head.number("llama.block_count", LAYERS);
    head.number("llama.feed_forward_length", FEED as u32);
    head.number("llama.attention.head_count", HEADS);
    head.number("llama.attention.head_count_kv", HEADS);
    head.number("llama.rope.dimension_count", WIDE as u32 / HEADS);
    head.number("llama.vocab_size", tokens.len() as u32);
    head.real("llama.attention.layer_norm_rms_epsilon", 1e-5);
    head.text("tokenizer.ggml.model", "gpt2");
    head.text("tokenizer.ggml.pre", "gpt-2");
    head.texts("tokenizer.ggml.tokens", &tokens);
    // 1: an ordinary token, 3: one that controls
    let kinds: Vec<i32> = (0..=end).map(|index| if index == end { 3 } else { 1 }).collect();
    head.kinds("tokenizer.ggml.token_type", &kinds);
    head.texts("tokenizer.ggml.merges", &MERGES.map(|(left, right)| format!("{left} {right}")));
    head.number("tokenizer.ggml.bos_token_id", end);
    head.number("tokenizer.ggml.eos_token_id", end);
    head.flag("tokenizer.ggml.add_bos_token", 0);

    let mut rng = seed.stream("test/llama").rng();
    let mut tensors = Tensors::default();
    let vocabulary = tokens.len() as u64;
    let mut random = |tensors: &mut Tensors, name: &str, shape: &[u64]| {
        let spread = 1.0 / (shape[0] as f64).sqrt();
        tensors.add(name, shape, &mut || rng.normal(0.0, spread) as f32);
    };
    let ones = |tensors: &mut Tensors, name: &str| tensors.add(name, &[WIDE], &mut || 1.0);
    random(&mut tensors, "token_embd.weight", &[WIDE, vocabulary]);
    ones(&mut tensors, "output_norm.weight");
    random(&mut tensors, "output.weight", &[WIDE, vocabulary]);
    for layer in 0..LAYERS {
        ones(&mut tensors, &format!("blk.{layer}.attn_norm.weight"));
        ones(&mut tensors, &format!("blk.{layer}.ffn_norm.weight"));
        for name in ["attn_q", "attn_k", "attn_v", "attn_output"] {
            random(&mut tensors, &format!("blk.{layer}.{name}.weight"), &[WIDE, WIDE]);
        }
        random(&mut tensors, &format!("blk.{layer}.ffn_gate.weight"), &[WIDE, FEED]);
        random(&mut tensors, &format!("blk.{layer}.ffn_up.weight"), &[WIDE, FEED]);
        random(&mut tensors, &format!("blk.{layer}.ffn_down.weight"), &[FEED, WIDE]);
    }
    file(&head, &tensors)
}

/// A token for each byte, those of the merges, and the end of text.
fn tokens() -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut strange = 256;
    for byte in 0..=255u32 {
        // GPT-2 writes bytes that are no visible character as characters from U+0100 on
        let visible = matches!(byte, 0x21..=0x7e | 0xa1..=0xac | 0xae..=0xff);
        let code = if visible { byte } else { strange };
        strange += u32::from(!visible);
        tokens.push(char::from_u32(code).unwrap().to_string());
    }
    tokens.extend(MERGES.map(|(left, right)| format!("{left}{right}")));
    tokens.push("<|end|>".into());
    tokens
}

fn file(head: &Head, tensors: &Tensors) -> Vec<u8> {
    let mut bytes = b"GGUF".to_vec();
    bytes.extend(3u32.to_le_bytes());
    bytes.extend(tensors.count.to_le_bytes());
    bytes.extend(head.count.to_le_bytes());
    bytes.extend(&head.bytes);
    bytes.extend(&tensors.infos);
    bytes.resize(bytes.len().next_multiple_of(ALIGNMENT), 0);
    bytes.extend(&tensors.data);
    bytes
}

/// Keys and values: a name, the number of the value's type, the value.
#[derive(Default)]
struct Head {
    count: u64,
    bytes: Vec<u8>,
}

impl Head {
    fn key(&mut self, name: &str, kind: u32) {
        self.count += 1;
        push_text(&mut self.bytes, name);
        self.bytes.extend(kind.to_le_bytes());
    }

    fn number(&mut self, name: &str, value: u32) {
        self.key(name, 4);
        self.bytes.extend(value.to_le_bytes());
    }

    fn real(&mut self, name: &str, value: f32) {
        self.key(name, 6);
        self.bytes.extend(value.to_le_bytes());
    }

    fn flag(&mut self, name: &str, value: u8) {
        self.key(name, 7);
        self.bytes.push(value);
    }

    fn text(&mut self, name: &str, value: &str) {
        self.key(name, 8);
        push_text(&mut self.bytes, value);
    }

    fn texts(&mut self, name: &str, values: &[String]) {
        self.list(name, 8, values.len());
        for value in values {
            push_text(&mut self.bytes, value);
        }
    }

    fn kinds(&mut self, name: &str, values: &[i32]) {
        self.list(name, 5, values.len());
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }

    fn list(&mut self, name: &str, kind: u32, length: usize) {
        self.key(name, 9);
        self.bytes.extend(kind.to_le_bytes());
        self.bytes.extend((length as u64).to_le_bytes());
    }
}

/// Tensors of 32-bit numbers: name, dimensions, type and place of each, then all their numbers.
#[derive(Default)]
struct Tensors {
    count: u64,
    infos: Vec<u8>,
    data: Vec<u8>,
}

impl Tensors {
    fn add(&mut self, name: &str, shape: &[u64], value: &mut dyn FnMut() -> f32) {
        self.count += 1;
        push_text(&mut self.infos, name);
        self.infos.extend((shape.len() as u32).to_le_bytes());
        self.infos.extend(shape.iter().flat_map(|length| length.to_le_bytes()));
        self.infos.extend(0u32.to_le_bytes());
        self.infos.extend((self.data.len() as u64).to_le_bytes());
        for _ in 0..shape.iter().product::<u64>() {
            self.data.extend(value().to_le_bytes());
        }
        self.data.resize(self.data.len().next_multiple_of(ALIGNMENT), 0);
    }
}

fn push_text(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend((text.len() as u64).to_le_bytes());
    bytes.extend(text.as_bytes());
}
