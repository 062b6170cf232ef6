; SYNTAX TEST "source.nc" "a program"

%
; <- keyword.control.percent.nc
O1234 (BRACKET)
; <----- entity.name.function.program.nc
;     ^^^^^^^^^ comment.block.parentheses.nc
N10 G0 G54 X1.5 Y-.25
; <--- constant.other.block-number.nc
;   ^^ keyword.operator.code.g.nc
;          ^ entity.name.tag.axis.nc
;           ^^^ constant.numeric.nc
;                ^^^^ constant.numeric.nc
G1Z-.5F100.M8
; <-- keyword.operator.code.g.nc
; ^ entity.name.tag.axis.nc
;     ^ storage.type.letter.nc
;          ^^ support.function.code.m.nc
#100=[#1+2] ; a remark
; <---- variable.parameter.nc
;           ^^^^^^^^^^ comment.line.semicolon.nc
IF [#1 GT 2] GOTO 5
; <-- keyword.control.flow.nc
;            ^^^^ keyword.control.flow.nc
/M1
; <- keyword.operator.delete.nc
;^^ support.function.code.m.nc
M30
; <--- support.function.code.m.nc
