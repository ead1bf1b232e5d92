//! The places of every instruction, and what it refers to.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

use addr2line::Context;
use addr2line::gimli::{self, DW_AT_comp_dir, DW_AT_name, Dwarf, EndianSlice, LittleEndian};
use iced_x86::{Decoder, DecoderOptions, Instruction, OpKind, Register};
use object::read::elf::ElfFile64;
use object::{Object, ObjectSection, ObjectSymbol};

use super::place::Home;
use super::{GLUE, Site, Stack};

type Slice<'a> = EndianSlice<'a, LittleEndian>;

/// What the code says about itself and about data.
pub struct Code {
    pub pieces: Vec<(Range<u64>, Stack)>,
    /// Addresses in operands, in the order of the code, and who names them.
    pub references: Vec<(u64, Stack)>,
    pub names: Names,
}

/// Files and symbols to places.
pub struct Names {
    home: Home,
    files: HashMap<String, (Rc<str>, Rc<str>, bool)>,
    functions: HashMap<String, Rc<str>>,
    modules: HashSet<Rc<str>>,
}

impl Code {
    /// Walks over the instructions of a section.
    pub fn read<'a>(file: &ElfFile64<'a>, text: &impl ObjectSection<'a>) -> Result<Self, String> {
        let error = |e: gimli::Error| e.to_string();
        let load = |id: gimli::SectionId| {
            let bytes = file.section_by_name(id.name()).and_then(|s| s.data().ok()).unwrap_or(&[]);
            Ok(EndianSlice::new(bytes, LittleEndian))
        };
        let dwarf = Dwarf::load(load).map_err(error)?;
        let home = home(&dwarf).map_err(error)?.ok_or("no debug information of a crate: build with -Cdebuginfo=1")?;
        let context = Context::from_dwarf(dwarf).map_err(error)?;
        let names = Names { home, files: HashMap::new(), functions: HashMap::new(), modules: HashSet::new() };
        let mut code = Code { pieces: Vec::new(), references: Vec::new(), names };

        let symbols: HashMap<u64, &str> =
            file.symbols().filter_map(|s| Some((s.address(), s.name().ok().filter(|n| !n.is_empty())?))).collect();
        let bytes = text.data().map_err(|e| e.to_string())?;
        let mut decoder = Decoder::with_ip(64, bytes, text.address(), DecoderOptions::NONE);
        let mut stack: Stack = [Site::nameless("linking")].into();
        let mut instruction = Instruction::default();
        while decoder.can_decode() {
            decoder.decode_out(&mut instruction);
            let at = instruction.ip();
            let sites = code.names.sites(&context, at).map_err(error)?;
            if !sites.is_empty() {
                if *sites != *stack {
                    stack = sites.into();
                }
            } else if let Some(symbol) = symbols.get(&at) {
                stack = [code.names.symbol(symbol)].into();
            } // else it pads what stands before it
            match code.pieces.last_mut() {
                Some((range, last)) if Rc::ptr_eq(last, &stack) => range.end = instruction.next_ip(),
                _ => code.pieces.push((at..instruction.next_ip(), stack.clone())),
            }
            code.references.extend(addresses(&instruction).map(|to| (to, stack.clone())));
        }
        for (_, stack) in &mut code.pieces {
            code.names.name_glue(stack);
        }
        for (_, stack) in &mut code.references {
            code.names.name_glue(stack);
        }
        Ok(code)
    }
}

/// What may be an address among the operands.
fn addresses(instruction: &Instruction) -> impl Iterator<Item = u64> {
    (0..instruction.op_count()).filter_map(|i| match instruction.op_kind(i) {
        OpKind::Memory if instruction.memory_segment() == Register::FS => None,
        OpKind::Memory => Some(instruction.memory_displacement64()),
        OpKind::Immediate32 | OpKind::Immediate32to64 | OpKind::Immediate64 => Some(instruction.immediate(i)),
        _ => None,
    })
}

/// Our crate is the one whose root has a relative path; its name stands behind it (`src/main.rs/@/paprsek.1606-cgu.0`).
fn home(dwarf: &Dwarf<Slice>) -> Result<Option<Home>, gimli::Error> {
    let mut units = dwarf.units();
    while let Some(header) = units.next()? {
        let unit = dwarf.unit(header)?;
        let mut entries = unit.entries();
        let Some(root) = entries.next_dfs()? else { continue };
        let text = |at| -> Result<String, gimli::Error> {
            let Some(value) = root.attr_value(at) else { return Ok(String::new()) };
            Ok(dwarf.attr_string(&unit, value)?.to_string_lossy().into_owned())
        };
        let name = text(DW_AT_name)?;
        if let Some((path, unit)) = name.split_once("/@/")
            && path.starts_with("src/")
        {
            let name = unit.split('.').next().unwrap_or(unit).to_string();
            return Ok(Some(Home { root: text(DW_AT_comp_dir)?, name }));
        }
    }
    Ok(None)
}

impl Names {
    fn sites(&mut self, context: &Context<Slice>, at: u64) -> Result<Vec<Site>, gimli::Error> {
        let mut frames = context.find_frames(at).skip_all_loads()?;
        let mut sites = Vec::new();
        while let Some(frame) = frames.next()? {
            let raw = frame.function.as_ref().and_then(|f| f.raw_name().ok()).unwrap_or_default();
            let (path, line) = frame.location.map_or(("", 0), |l| (l.file.unwrap_or(""), l.line.unwrap_or(0)));
            let (file, module, ours) = self.file(path);
            sites.push(Site { module, function: self.function(&raw), file, line, ours });
        }
        Ok(sites)
    }

    fn file(&mut self, path: &str) -> (Rc<str>, Rc<str>, bool) {
        if let Some(known) = self.files.get(path) {
            return known.clone();
        }
        let (module, ours) = self.home.module(path);
        let short = path.strip_prefix(&*self.home.root).unwrap_or(path).trim_start_matches('/');
        let short = short.rsplit_once("/index.crates.io-").and_then(|(_, f)| f.split_once('/')).map_or(short, |f| f.1);
        let known: (Rc<str>, Rc<str>, bool) = (short.into(), module.into(), ours);
        if ours {
            self.modules.insert(known.1.clone());
        }
        self.files.insert(path.into(), known.clone());
        known
    }

    fn function(&mut self, raw: &str) -> Rc<str> {
        if !self.functions.contains_key(raw) {
            let name = format!("{:#}", rustc_demangle::demangle(raw));
            self.functions.insert(raw.into(), name.into());
        }
        self.functions[raw].clone()
    }

    /// The place of a symbol without lines: a static, or a function of C.
    pub fn symbol(&mut self, raw: &str) -> Site {
        let function = self.function(raw);
        if *function == *raw {
            return Site { function, ..Site::nameless("linking") };
        }
        let name = krate(&function);
        let found = (name == self.home.name).then(|| self.module_named(&function)).flatten();
        let (module, ours) = found.map_or((name.into(), false), |module| (module, true));
        Site { file: function.clone(), module, function, line: 0, ours }
    }

    /// The module of ours that stands first in a name.
    fn module_named(&self, name: &str) -> Option<Rc<str>> {
        let path = &name[name.find(&format!("{}::", self.home.name))?..];
        let end = path.find(|c: char| !c.is_alphanumeric() && c != '_' && c != ':').unwrap_or(path.len());
        let whole = path[..end].trim_end_matches(':');
        let mut paths = std::iter::successors(Some(whole), |path| Some(path.rsplit_once("::")?.0));
        paths.find_map(|path| self.modules.get(path).cloned())
    }

    /// Glue that was not inlined belongs to the module of ours among its types.
    fn name_glue(&self, stack: &mut Stack) {
        if !stack.iter().all(|s| GLUE.contains(&&*s.module)) {
            return;
        }
        let last = &stack[stack.len() - 1];
        if let Some(module) = self.module_named(&last.function) {
            let site = Site { module, ours: true, ..last.clone() };
            *stack = stack.iter().cloned().chain([site]).collect();
        }
    }
}

/// The crate that a demangled name begins with.
fn krate(name: &str) -> &str {
    let name = name.trim_start_matches(|c: char| !c.is_alphanumeric() && c != '_');
    name.split("::").next().unwrap_or(name)
}
