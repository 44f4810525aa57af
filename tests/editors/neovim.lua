-- What a user does in Neovim with `odgen lsp`: opening files, messages, completion, hover, definition, rename, quick fixes.
--
--     nvim -l tests/editors/neovim.lua ODGEN
--
-- Another Neovim is the editor: it is set up as docs/book/editor.md shows, and gets keys as from a keyboard. The test waits
-- for states of that editor, and never for a time; after PATIENCE a state never comes. Exit code 1 when anything differs.

local PATIENCE = 60000
local root = vim.fs.dirname(vim.fs.dirname(vim.fs.dirname(vim.fn.fnamemodify(arg[0], ":p"))))
local odgen = vim.fn.fnamemodify(arg[1], ":p")
local folder = vim.fn.tempname()
local cases = root .. "/tests/editors/files/"

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read("a")
  file:close()
  return text
end

local function write(path, text)
  vim.fn.mkdir(vim.fs.dirname(path), "p")
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
end

-- The set-up of the documentation, as it is there.
local page = read(root .. "/docs/book/editor.md")
local init = page:match("\n### Neovim.-```lua\n(.-)```")
assert(init, "docs/book/editor.md shows no set-up for Neovim")
write(folder .. "/init.lua", init)
vim.fn.mkdir(folder .. "/bin", "p")
assert(vim.uv.fs_symlink(odgen, folder .. "/bin/odgen"))
for name in vim.fs.dir(cases) do
  write(folder .. "/" .. name, read(cases .. name))
end

-- An EDS of the same device, and one that is stored in Windows-1252.
local built = vim.system({ odgen, "build", "valve.od.yaml", "--out", "." }, { cwd = folder }):wait()
assert(built.code == 0, built.stderr)
local eds = read(folder .. "/eds/valve.eds")
write(folder .. "/drive.eds", eds)
local names = "VendorName=M\xFCller Hydraulik f\xFCr gro\xDFe Ventile"
write(folder .. "/latin1.eds", (eds:gsub("VendorName=[^\r\n]*", names)))

local environment = {
  PATH = folder .. "/bin:" .. vim.env.PATH,
  XDG_CACHE_HOME = folder .. "/cache",
  XDG_STATE_HOME = folder .. "/state",
  XDG_CONFIG_HOME = folder .. "/config",
}
local command = { vim.v.progpath, "--headless", "--embed", "-n", "-i", "NONE", "-u", folder .. "/init.lua" }
local editor = vim.fn.jobstart(command, { rpc = true, cwd = folder, env = environment })

local function lua(code, ...)
  return vim.rpcrequest(editor, "nvim_exec_lua", code, { ... })
end

local function keys(text)
  vim.rpcrequest(editor, "nvim_input", text)
end

local done, wrong = 0, {}

local function check(is_right, what)
  done = done + 1
  if not is_right then
    wrong[#wrong + 1] = what
  end
end

local function same(found, expected, what)
  check(vim.deep_equal(found, expected), what .. ": " .. vim.inspect(found) .. ", expected " .. vim.inspect(expected))
end

-- Waits for a state of the editor.
local function await(what, code, ...)
  local arguments = { ... }
  local result
  local came = vim.wait(PATIENCE, function()
    result = lua(code, unpack(arguments))
    return result ~= nil and result ~= false and result ~= vim.NIL
  end, 5)
  check(came, "it never came to this: " .. what)
  return came and result or nil
end

local ATTACHED = "return #vim.lsp.get_clients({ bufnr = 0 }) > 0"
local MESSAGES = [[
  local messages = vim.diagnostic.get(0)
  if #messages == 0 then return nil end
  return vim.tbl_map(function(one) return { (one.code or "") .. ":" .. one.lnum + 1, one.message } end, messages)]]
local NO_MESSAGES = "return #vim.diagnostic.get(0) == 0"

-- Opens a file; what is changed in the last one is given up.
local function open(name, how)
  keys("<Esc><C-c>")
  lua("vim.cmd('silent! pclose') vim.cmd('enew!') vim.cmd('silent! bwipeout! ' .. vim.fn.fnameescape(...))", name)
  lua("vim.cmd('edit! ' .. (select(2, ...) or '') .. ' ' .. vim.fn.fnameescape((...)))", folder .. "/" .. name, how)
  await(name .. " is attached", ATTACHED)
  -- An answer about it: the server has read it.
  lua(
    [[local about = { textDocument = vim.lsp.util.make_text_document_params() }
      vim.lsp.buf_request_sync(0, "textDocument/documentSymbol", about, ...)]],
    PATIENCE
  )
end

-- Puts the cursor on the first place of a text, so many characters further.
local function put(text, further)
  lua(
    [[local text, further = ...
      vim.fn.cursor(1, 1)
      local line, column = unpack(vim.fn.searchpos("\\V" .. vim.fn.escape(text, "\\"), "cW"))
      assert(line > 0, "there is no " .. text)
      vim.api.nvim_win_set_cursor(0, { line, column - 1 + further })]],
    text,
    further or 0
  )
end

local function replace(from, to)
  lua(
    [[local from, to = ...
      local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
      local start, stop = text:find(from, 1, true)
      assert(start, "there is no " .. from)
      vim.api.nvim_buf_set_lines(0, 0, -1, false, vim.split(text:sub(1, start - 1) .. to .. text:sub(stop + 1), "\n"))]],
    from,
    to
  )
end

local LINE = "return vim.api.nvim_get_current_line()"

-- Writes a text with a mark instead of another one, types at the mark, and takes an offer; the line then, and all offers.
-- After a space or a bracket the offers come by themselves, otherwise with <C-Space>.
local function complete(from, to, typed, label)
  replace(from, to)
  put("¦")
  keys("s" .. typed)
  local offers = await(
    label .. " is offered after " .. typed,
    [[local items = vim.fn.complete_info({ "items", "pum_visible" })
      if items.pum_visible == 0 then return nil end
      local labels = vim.tbl_map(function(item) return item.abbr end, items.items)
      return vim.tbl_contains(labels, (...)) and labels or nil]],
    label
  )
  if not offers then
    keys("<Esc>")
    return nil, {}
  end
  local at = vim.fn.index(offers, label)
  keys(("<C-n>"):rep(at + 1) .. "<C-y>")
  await(label .. " is taken", "return vim.fn.pumvisible() == 0")
  keys("<Esc>")
  await("back in normal mode", "return vim.api.nvim_get_mode().mode == 'n'")
  return lua(LINE), offers
end

local function shown_by(action)
  lua("vim.lsp.buf.hover({ silent = true })")
  local lines = await(
    action,
    [[for _, window in ipairs(vim.api.nvim_list_wins()) do
        if vim.api.nvim_win_get_config(window).relative ~= "" then
          local lines = vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false)
          vim.api.nvim_win_close(window, true)
          return table.concat(lines, "\n")
        end
      end]]
  )
  return lines or ""
end

local function holds(text, part, what)
  check(text:find(part, 1, true) ~= nil, what .. ": no " .. part .. " in " .. text)
end

local parts = {}

function parts.opening()
  open("valve.od.yaml")
  await("the specification has no message", NO_MESSAGES)
  -- A file is chosen by what is in it, not by its name.
  open("node5.yaml")
  open("press.yaml")
  lua("vim.cmd('edit! ' .. vim.fn.fnameescape(...))", folder .. "/foreign.yaml")
  same(lua("return #vim.lsp.get_clients({ bufnr = 0 })"), 0, "a foreign YAML file is attached")
end

function parts.messages()
  open("valve.od.yaml")
  replace("unit: decibar", "unit: decibr")
  local messages = await("a message", MESSAGES)
  holds(vim.inspect(messages), "OD0608:11", "code and line of the message")
  lua("vim.lsp.buf.code_action({ apply = true, context = { only = { 'quickfix' }, diagnostics = {} }, range = { start = { 11, 0 }, ['end'] = { 11, 90 } } })")
  await("the quick fix is made", "return vim.fn.search('unit: decibar', 'nw') > 0")
  await("no message is left", NO_MESSAGES)
end

function parts.completion()
  open("valve.od.yaml")
  -- A name with spaces, as a whole.
  same(
    complete("map: [set pressure]", "map: [¦]", "set p<C-Space>", "set pressure"),
    "    receive: {1: {map: [set pressure]}}",
    "a name with a space"
  )
  open("valve.od.yaml")
  local line, offers = complete("access: ro, ", "¦, ", "acc<C-Space>", "access")
  holds(line or "", "unit: decibar, access: , pdo", "a key with its space")
  open("valve.od.yaml")
  line, offers = complete("access: ro, ", "access:¦, ", " ", "rw")
  same(offers[1], "ro", "values after `access: `")
  holds(line or "", "access: rw,", "the value is written")
  open("valve.od.yaml")
  line = complete("unit: decibar, access: ro", "unit: ¦, access: ro", "ba<C-Space>", "decibar")
  holds(line or "", "unit: decibar, access", "a unit by symbol")
  open("valve.od.yaml")
  line = complete("default: 2.5 bar", "default: 2.5¦", " ", "2.5 bar")
  holds(line or "", "default: 2.5 bar, max", "a unit after its number")
  open("node5.yaml")
  line = complete("  set pressure: 6.0 bar", "  ¦", "set<C-Space>", "set pressure")
  same(line, "  set pressure: ", "an entry of a parameter file")
  open("press.yaml")
  line = complete("{set pressure: 6.0 bar}", "{¦}", "set<C-Space>", "set pressure")
  same(line, "      valve: {set pressure: }", "an entry of a plant")
  open("drive.eds")
  line = complete("DataType=0x0006\n", "¦\n", "Dat<C-Space>", "DataType")
  same(line, "DataType=", "a key of an EDS")
  open("drive.eds")
  line = complete("DataType=0x0006\n", "DataType=¦\n", "UNSIGNED1<C-Space>", "0x0006")
  same(line, "DataType=0x0006", "a data type by its name")
end

function parts.hover_and_definition()
  open("valve.od.yaml")
  put("map: [set", 8)
  holds(shown_by("hover in a PDO"), "decibar", "hover shows the unit")
  lua("vim.lsp.buf.definition()")
  await("the cursor is at the object", "return vim.fn.line('.') == 11")
  open("node5.yaml")
  await("the values are right", NO_MESSAGES)
  put("set pressure", 2)
  holds(shown_by("hover in a parameter file"), "2000h", "hover shows the entry")
  lua("vim.lsp.buf.definition()")
  await("the specification is shown", "return vim.fs.basename(vim.api.nvim_buf_get_name(0)) == 'valve.od.yaml'")
  open("press.yaml")
  put("set pressure: 5.8", 2)
  holds(shown_by("hover in a plant"), "2000h", "hover shows the entry")
  open("drive.eds")
  put("0x20000010", 4)
  holds(shown_by("hover over a mapped entry"), "set pressure", "hover shows the mapped entry")
  lua("vim.lsp.buf.definition()")
  await("the section of the mapped object", "return vim.api.nvim_get_current_line() == '[2000]'")
end

function parts.rename()
  open("node5.yaml")
  await("the values are right", NO_MESSAGES)
  lua("vim.o.hidden = true vim.cmd('edit ' .. vim.fn.fnameescape(...))", folder .. "/valve.od.yaml")
  await("the specification is attached", ATTACHED)
  put("set pressure", 2)
  lua("vim.lsp.buf.rename('target pressure')")
  await("the object has the name", "return vim.fn.search('name: target pressure', 'nw') > 0")
  await("the PDO has the name", "return vim.fn.search('map: \\\\[target pressure\\\\]', 'nw') > 0")
  -- In the parameter file, which is open, and in the plant, which is not.
  for _, name in ipairs({ "node5.yaml", "press.yaml" }) do
    await(
      name .. " has the name",
      [[local buffer = vim.fn.bufnr((...))
        if buffer < 0 then return nil end
        local text = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n")
        return text:find("target pressure:", 1, true) and not text:find("set pressure:", 1, true)]],
      name
    )
  end
end

function parts.misread()
  open("latin1.eds", "++enc=cp850")
  local messages = await("a message about the encoding", MESSAGES)
  holds(vim.inspect(messages), "stored as Windows-1252", "the encoding of the file is named")
end

function parts.hints()
  open("valve.od.yaml")
  await("the specification has no message", NO_MESSAGES)
  lua("vim.lsp.inlay_hint.enable(true)")
  local labels = await(
    "hints",
    [[local hints = vim.lsp.inlay_hint.get({ bufnr = 0 })
      if #hints == 0 then return nil end
      return vim.tbl_map(function(hint) return hint.inlay_hint.label end, hints)]]
  )
  check(vim.tbl_contains(labels or {}, "25"), "no raw value: " .. vim.inspect(labels))
  -- 6 in steps of 1 repeats the line.
  check(not vim.tbl_contains(labels or {}, "6"), "a hint repeats the line: " .. vim.inspect(labels))
end

for _, name in ipairs({ "opening", "messages", "completion", "hover_and_definition", "rename", "misread", "hints" }) do
  local ok, failure = pcall(parts[name])
  check(ok, name .. ": " .. tostring(failure))
end
pcall(lua, "vim.cmd('qall!')")
vim.fn.jobstop(editor)
vim.fn.delete(folder, "rf")
for _, what in ipairs(wrong) do
  io.stderr:write(what .. "\n")
end
print(("%d passed, %d failed in Neovim %s"):format(done - #wrong, #wrong, tostring(vim.version())))
os.exit(#wrong == 0 and 0 or 1)
