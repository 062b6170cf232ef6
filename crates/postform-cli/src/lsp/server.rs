//! The state of the server: the open texts, the results for them, and the editor's capabilities.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gen_lsp_types as lsp;
use postform::internals::control::{self, Control};
use postform::internals::ide::program;
use postform::internals::nc::{RunSettings, settings_for};
use serde::Deserialize;

use super::programs::{Programs, form_of};
use super::texts::{Kind, Text, Texts};
use super::view::{View, root_of};
use crate::config::Config;
use crate::files;

/// The editor's settings under `postform`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Settings {
    /// The control of programs if neither the program nor a postform.toml names a control: a name or a file.
    pub control: Option<String>,
    /// The path of the current job of forms. This job ranks before the jobs in postform.toml.
    pub job: Option<PathBuf>,
    /// Hints after words: `on`, `off`, or `auto`. With `auto`, files of more than 500 lines show no hints.
    pub inlay_hints: Option<String>,
}

impl Settings {
    /// Takes over the values that are set; all other values stay unchanged.
    pub fn take(&mut self, said: Settings) {
        self.control = said.control.or(self.control.take());
        self.job = said.job.or(self.job.take());
        self.inlay_hints = said.inlay_hints.or(self.inlay_hints.take());
    }
}

/// The capabilities of the editor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Client {
    /// Completions may contain placeholders.
    pub snippets: bool,
    /// Edits may be shown for confirmation.
    pub annotations: bool,
    /// The editor can open a file on request.
    pub shows: bool,
    /// The editor requests programs with `postform/program` and needs no files.
    pub virtual_programs: bool,
    /// The editor can report changes of files on the disk.
    pub watches: bool,
    /// The editor can refresh its hints on request.
    pub refreshes_hints: bool,
    /// The editor can refresh its lenses on request.
    pub refreshes_lenses: bool,
}

/// The state between two messages.
#[derive(Default)]
pub struct Server {
    pub texts: Texts,
    pub settings: Settings,
    pub client: Client,
    /// Folders that are open in the editor.
    pub folders: Vec<PathBuf>,
    /// Texts whose findings must be sent.
    pub stale: BTreeSet<String>,
    /// Whether something changed outside the viewed form, so that hints and lenses of the form may have changed, too.
    pub beside: bool,
    /// Programs that were written as files for the editor.
    pub programs: RefCell<Programs>,
    views: RefCell<HashMap<String, Rc<View>>>,
    /// The results from the last time that a form printed a program; they are kept, because a form with an incomplete
    /// word prints no program.
    last: RefCell<HashMap<String, Rc<View>>>,
    roots: RefCell<HashMap<PathBuf, PathBuf>>,
}

impl Server {
    /// A text changed: results for forms are dropped, because the text may be a form, a called form, or a job.
    pub fn changed(&mut self, uri: &lsp::Uri) {
        let kind = self.texts.get(uri).map(|text| text.kind);
        let views = std::mem::take(self.views.get_mut());
        self.last.get_mut().extend(views.into_iter().filter(|(_, view)| view.document.post().is_some()));
        // other forms may call a changed form, and a changed form may print open jobs; a program does not depend on
        // other texts
        let touched = |text: &&Text| kind == Some(Kind::Form) && matches!(text.kind, Kind::Form | Kind::Other);
        self.stale.extend(self.texts.all().filter(touched).map(|text| text.uri.as_ref().to_owned()));
        self.stale.insert(uri.as_ref().to_owned());
        self.beside |= kind != Some(Kind::Form);
    }

    /// Texts were opened or closed, files or settings changed: all results are dropped.
    pub fn forget(&mut self) {
        self.roots.get_mut().clear();
        self.views.get_mut().clear();
        self.stale.extend(self.texts.all().map(|text| text.uri.as_ref().to_owned()));
        self.beside = true;
    }

    /// The results for an open form.
    pub fn view(&self, uri: &lsp::Uri) -> Option<Rc<View>> {
        let text = self.texts.get(uri).filter(|text| text.kind == Kind::Form)?;
        if let Some(view) = self.views.borrow().get(uri.as_ref()) {
            return Some(Rc::clone(view));
        }
        let root = text.path.as_deref().map(|path| self.root(path));
        let view = Rc::new(View::new(text, root.as_deref(), &self.texts, self.job().as_deref()));
        self.views.borrow_mut().insert(uri.as_ref().to_owned(), Rc::clone(&view));
        Some(view)
    }

    /// The results for the form from the last time that it printed a program.
    pub fn last_view(&self, uri: &lsp::Uri) -> Option<Rc<View>> {
        self.last.borrow().get(uri.as_ref()).cloned()
    }

    /// The results for a form by its file, open or not.
    pub fn view_of_form(&self, path: &Path) -> Option<Rc<View>> {
        let path = std::path::absolute(path).ok()?;
        if let Some(open) = self.texts.of_path(&path) {
            return self.view(&open.uri.clone());
        }
        let bytes = files::read_form(&path).ok()?;
        let mut closed = Texts::default();
        let uri = super::uri::of_path(&path);
        closed.open(uri.clone(), "postform", 0, String::from_utf8_lossy(&bytes).into_owned());
        let text = closed.get(&uri)?;
        Some(Rc::new(View::new(text, Some(&path), &self.texts, self.job().as_deref())))
    }

    fn root(&self, path: &Path) -> PathBuf {
        let known = self.roots.borrow().get(path).cloned();
        known.unwrap_or_else(|| {
            let root = root_of(path, &self.texts);
            self.roots.borrow_mut().insert(path.to_path_buf(), root.clone());
            root
        })
    }

    /// The job in the settings, relative to the first open folder.
    fn job(&self) -> Option<PathBuf> {
        let job = self.settings.job.as_ref().filter(|job| !job.as_os_str().is_empty())?;
        Some(self.folders.first().map_or_else(|| job.clone(), |folder| folder.join(job)))
    }

    /// The control of a program, and the place that names the control: a comment in the program, its form,
    /// postform.toml, the editor's settings, its language or file name, or the default.
    ///
    /// # Errors
    /// A message: the control does not exist, or its file can't be read.
    pub fn control_of(&self, text: &Text) -> Result<(&'static Control, &'static str), String> {
        let folder = text.path.as_deref().map(files::folder).unwrap_or(Path::new("."));
        if let Some(name) = program::named_control(&text.source.text) {
            return Ok((self.named(name, folder)?, "named in the program"));
        }
        if let Some((uri, _)) = form_of(self, text) {
            let control = self.view(&uri).and_then(|view| view.document.checked().form.settings.control);
            return Ok((control.unwrap_or_else(Control::usual), "of its form"));
        }
        if let Some(path) = text.path.as_deref()
            && let Some(control) = Config::near(path)?.control
        {
            return Ok((control, "of postform.toml"));
        }
        match self.settings.control.as_deref().filter(|name| !name.is_empty()) {
            Some(name) => {
                Ok((self.named(name, self.folders.first().map_or(folder, PathBuf::as_path))?, "of the settings"))
            }
            None => {
                let settings = RunSettings { assumed: true, ..RunSettings::new(Control::usual()) };
                let name = text.path.as_deref().unwrap_or(Path::new(""));
                let found = settings_for(&mut Cursor::new(text.source.text.as_bytes()), name, settings);
                match found.ok().filter(|found| !found.assumed) {
                    Some(found) => Ok((found.control, "recognised by the program or its file name")),
                    None => Ok((Control::usual(), "default: no control is named")),
                }
            }
        }
    }

    fn named(&self, name: &str, folder: &Path) -> Result<&'static Control, String> {
        if control::is_file(name) {
            return files::control(&folder.join(name));
        }
        Control::named(&name.to_ascii_lowercase()).ok_or_else(|| {
            let known: Vec<&str> = control::names().collect();
            format!(
                "there is no control `{}`; the controls are {}",
                postform::internals::terminal::escaped(name),
                known.join(", ")
            )
        })
    }
}
