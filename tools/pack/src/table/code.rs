//! The places of every instruction, and the addresses that it names.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use addr2line::Context;
use addr2line::gimli::{self, DW_AT_comp_dir, DW_AT_name, Dwarf, EndianSlice, LittleEndian};
use iced_x86::{Decoder, DecoderOptions, Instruction, OpKind, Register};
use object::read::elf::ElfFile64;
use object::{Object, ObjectSection, ObjectSymbol};

use super::place::Home;
use super::{Piece, Site, Stack, is_glue, name, outermost};

type Slice<'a> = EndianSlice<'a, LittleEndian>;

/// What the code says about itself and about data.
pub struct Code {
    pub pieces: Vec<Piece>,
    /// Addresses in operands, in the order of the code, and who names them.
    pub references: Vec<(u64, Stack)>,
    pub names: Names,
}

impl Code {
    /// Walks over the instructions.
    pub fn read(file: &ElfFile64) -> Result<Self, String> {
        let error = |e: gimli::Error| e.to_string();
        let load = |id: gimli::SectionId| {
            let bytes = file.section_by_name(id.name()).and_then(|s| s.data().ok()).unwrap_or(&[]);
            Ok(EndianSlice::new(bytes, LittleEndian))
        };
        let dwarf = Dwarf::load(load).map_err(error)?;
        let home = home(&dwarf).map_err(error)?.ok_or("no lines of Rust: build with -Cdebuginfo=1, unstripped")?;
        let context = Context::from_dwarf(dwarf).map_err(error)?;
        let mut names = Names::new(home);

        let named = |s: object::read::elf::ElfSymbol64<'_, '_, _>| Some((s.address(), s.name().ok()?.to_string()));
        let symbols: HashMap<u64, String> = file.symbols().filter_map(named).filter(|(_, n)| !n.is_empty()).collect();
        let text = file.section_by_name(".text").ok_or("no .text")?;
        let bytes = text.data().map_err(|e| e.to_string())?;

        let (mut pieces, mut references) = (Vec::<Piece>::new(), Vec::new());
        let mut stack: Stack = [Site::nowhere("linking")].into();
        for instruction in Decoder::with_ip(64, bytes, text.address(), DecoderOptions::NONE).iter() {
            let (start, end) = (instruction.ip(), instruction.next_ip());
            let sites = names.sites(&context, start).map_err(error)?;
            if !sites.is_empty() {
                if sites != *stack {
                    stack = sites.into();
                }
            } else if let Some(symbol) = symbols.get(&start) {
                stack = [names.symbol(symbol)].into();
            } // else it pads what stands before it
            match pieces.last_mut() {
                Some((range, last)) if Rc::ptr_eq(last, &stack) => range.end = end,
                _ => pieces.push((start..end, stack.clone())),
            }
            references.extend(addresses(&instruction).map(|to| (to, stack.clone())));
        }

        // Only now all modules and crates are known by their files.
        for stack in pieces.iter_mut().map(|p| &mut p.1).chain(references.iter_mut().map(|r| &mut r.1)) {
            if stack.iter().all(is_glue)
                && let Some(site) = names.client(outermost(stack))
            {
                *stack = stack.iter().cloned().chain([site]).collect();
            }
        }
        Ok(Code { pieces, references, names })
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

/// Our crate is the one whose root has the shortest relative path; its name stands behind the path, as in
/// `src/bin/paprsek/main.rs/@/paprsek.1606792f32def728-cgu.0`.
fn home(dwarf: &Dwarf<Slice>) -> Result<Option<Home>, gimli::Error> {
    let mut found: Option<(usize, Home)> = None;
    let mut units = dwarf.units();
    while let Some(header) = units.next()? {
        let unit = dwarf.unit(header)?;
        let mut entries = unit.entries();
        let Some(entry) = entries.next_dfs()? else { continue };
        let text = |at| match entry.attr_value(at) {
            Some(value) => Ok::<_, gimli::Error>(dwarf.attr_string(&unit, value)?.to_string_lossy().into_owned()),
            None => Ok(String::new()),
        };
        let name = text(DW_AT_name)?;
        let Some((path, name)) = name.split_once("/@/").filter(|(path, _)| !path.starts_with('/')) else { continue };
        let root = path.ends_with("/main.rs") || path.ends_with("/lib.rs");
        let Some((folder, _)) = path.split_once("src/").filter(|_| root) else { continue };
        if found.as_ref().is_none_or(|(length, _)| folder.len() < *length) {
            let root = format!("{}/{folder}", text(DW_AT_comp_dir)?).trim_end_matches('/').to_string();
            found = Some((folder.len(), Home { root, name: name.split('.').next().unwrap_or(name).to_string() }));
        }
    }
    Ok(found.map(|(_, home)| home))
}

/// Files and symbols to places.
pub struct Names {
    home: Home,
    /// Short name, module, and whether it is ours, by path.
    files: HashMap<String, (Rc<str>, Rc<str>, bool)>,
    functions: HashMap<String, Rc<str>>,
    /// Modules of ours, and crates.
    modules: HashSet<Rc<str>>,
}

impl Names {
    fn new(home: Home) -> Self {
        // The package itself, though no line may be its root's.
        let modules = HashSet::from([home.name.as_str().into()]);
        Self { home, files: HashMap::new(), functions: HashMap::new(), modules }
    }

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
        let known: (Rc<str>, Rc<str>, bool) = (self.home.short(path).into(), module.into(), ours);
        self.modules.insert(known.1.clone());
        self.files.insert(path.into(), known.clone());
        known
    }

    fn function(&mut self, raw: &str) -> Rc<str> {
        if let Some(known) = self.functions.get(raw) {
            return known.clone();
        }
        let name: Rc<str> = format!("{:#}", rustc_demangle::demangle(raw)).into();
        self.functions.insert(raw.into(), name.clone());
        name
    }

    /// The place of a symbol without lines: a static, or a function of C.
    pub fn symbol(&mut self, raw: &str) -> Site {
        let function = self.function(raw);
        let module = name::paths(&function).next().and_then(|path| self.module(path));
        let (mut module, ours) = module.unwrap_or_else(|| ("linking".into(), false));
        // A module that has tables and no code of its own is known by their paths alone.
        if ours && *module == *self.home.name {
            let parent = name::paths(&function).next().and_then(|path| path.rsplit_once("::"));
            module = parent.map_or(module, |(parent, _)| parent.into());
        }
        Site { file: function.clone(), module, function, line: 0, ours }
    }

    /// Glue that stands alone works for the crate among its types, for ours before others.
    fn client(&self, glue: &Site) -> Option<Site> {
        let sites = name::paths(&glue.function).filter_map(|path| self.module(path));
        let sites = sites.map(|(module, ours)| Site { module, ours, ..glue.clone() });
        let clients: Vec<_> = sites.filter(|site| !is_glue(site)).collect();
        clients.iter().find(|site| site.ours).or(clients.first()).cloned()
    }

    /// The module of ours that a path is in, else its crate.
    fn module(&self, path: &str) -> Option<(Rc<str>, bool)> {
        let ours = name::krate(path) == self.home.name;
        let mut shorter = std::iter::successors(Some(path), |path| Some(path.rsplit_once("::")?.0));
        Some((shorter.find_map(|path| self.modules.get(path))?.clone(), ours))
    }
}
